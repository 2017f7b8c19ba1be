#pragma once

#include <memory>
#include <optional>
#include <span>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/drag.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

struct EditSystem;

/// Prepares a linear drag that is available long before the exact response. It needs only the n x n
/// system and four columns per handle (laplacian_response); the exact response needs the 3n x 3n
/// system and twelve columns. The preview is exact for translations. In rotations, its details do
/// not rotate.
///
///     DragPreview preview(mesh.positions, topology, region, options);
///     Drag drag(preview.response());          // drags while the solver is prepared
///     DeformSolver solver(preview, kernels);  // on another thread; then replaces the preview
class DragPreview {
 public:
  /// Reports the stages "pattern", "order", "laplacian" and "preview". `topology` must outlive the
  /// object. Throws the errors of DeformSolver's constructor.
  DragPreview(std::span<const Eigen::Vector3d> rest, const Topology& topology, EditRegion region,
              const DeformOptions& options, const Progress& progress = {});
  /// Like the constructor above, but reuses the data in `prepared`. The stage "constraints" then
  /// replaces "pattern" and "order". If `handles` is set, response() has columns only for these
  /// handles.
  DragPreview(PreparedRegion& prepared, std::span<const Eigen::Vector3d> rest, EditRegion region,
              const DeformOptions& options,
              std::optional<std::span<const std::size_t>> handles = {},
              const Progress& progress = {});

  /// Returns the linear response to all handles, as DeformSolver::response does. Poses of a preview
  /// can be used with the solver constructed from it, and vice versa.
  const std::shared_ptr<const DragResponse>& response() const { return response_; }
  /// Returns the linear response to `handles`. Solves four right-hand sides per handle.
  std::shared_ptr<const DragResponse> response_of(std::span<const std::size_t> handles) const;

  const EditRegion& region() const;
  const StageTimings& timings() const { return timings_; }

  /// Returns the edit that this preview shares with a DeformSolver constructed from it.
  const std::shared_ptr<const EditSystem>& system() const { return system_; }

 private:
  DragPreview(std::shared_ptr<const EditSystem> system,
              std::optional<std::span<const std::size_t>> handles, const Progress& progress);

  std::shared_ptr<const EditSystem> system_;
  std::shared_ptr<const DragResponse> response_;
  StageTimings timings_;
};

}  // namespace lapwing
