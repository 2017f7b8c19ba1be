#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/certificate.h"
#include "lapwing/deform/drag.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/elastic/prepared_region.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing {

class DragPreview;
struct DeformSolverState;
struct EditSystem;

struct DeformResult {
  Positions positions;  ///< of the whole mesh; vertices that do not move keep their bits
  Certificate certificate;
  /// The S_i that the handles ask for (rest_stretch.h), per vertex of the mesh; empty for the
  /// identity.
  std::vector<Eigen::Matrix3d> rest_stretch = {};
  /// The motions asked for. A handle with free orientation has the rotation that was found.
  HandleMotions motions = {};
};

/// A region prepared for many solutions: detail-preserving deformation by affine motions of its
/// handles (paper, sections 3 and 4; ENERGY.md section 3).
///
///     DeformSolver solver(mesh.positions, topology, region, {}, kernels);
///     mesh.positions = solver.solve(motions).positions;
///
/// Immutable, so several threads may call all members. `topology` and `kernels` must outlive the
/// solver. Takes about 4 kB a vertex with settling, twice that after the first minimization, and 8
/// kB without.
class DeformSolver {
 public:
  /// Factors the n x n system and, without settling, the 3n x 3n system (LinearResponse). Stages:
  /// "pattern", "order", "laplacian"; without settling "assemble", "analyze", "normal_matrix",
  /// "factor"; at last "shares". Throws InputError for a region that does not fit the mesh,
  /// SolverError if a component is not anchored or memory is short, GpuError, Cancelled.
  DeformSolver(std::span<const Eigen::Vector3d> rest, const Topology& topology, EditRegion region,
               const DeformOptions& options, Kernels& kernels, const Progress& progress = {});

  /// Reuses what `prepared` keeps, with the same bits. The stage "constraints" replaces "pattern"
  /// and "order", and stages without work are left out.
  DeformSolver(PreparedRegion& prepared, std::span<const Eigen::Vector3d> rest, EditRegion region,
               const DeformOptions& options, Kernels& kernels, const Progress& progress = {});

  /// Shares what `preview` has prepared. May run on another thread while `preview` is dragged.
  DeformSolver(const DragPreview& preview, Kernels& kernels, const Progress& progress = {});
  ~DeformSolver();
  DeformSolver(DeformSolver&&) noexcept;
  DeformSolver& operator=(DeformSolver&&) noexcept;

  /// Returns the surface for one motion per handle, with its certificate; stage "settle" if the
  /// options settle. Identity motions return the rest positions bit for bit. Throws InputError for
  /// another number of motions and for motions that are too far, SolverError if the certificate
  /// does not hold, Cancelled.
  DeformResult solve(std::span<const Eigen::Affine3d> motions, const Progress& progress = {}) const;

  /// The same for accumulated turns: the surface winds as its handles turned, as far as it can hold
  /// the winding. Free orientations require settling with soft constraints.
  DeformResult solve(const HandleMotions& motions, const Progress& progress = {}) const;

  /// Minimizes at each motion of `path` in turn and then at `motions`, each from the previous
  /// minimum. Far motions have several minima; the path decides which one is found. Large regions
  /// follow the path on their coarse proxy. A motion to which a handle turns by more than 90
  /// degrees starts from rest again.
  DeformResult solve_along(std::span<const HandleMotions> path, const HandleMotions& motions,
                           const Progress& progress = {}) const;

  /// Starts from a pose of this region (DragSession::state), so that a drag ends in the minimum
  /// that it has shown. The pose is ignored if it is empty, if the options do not settle, or if a
  /// handle has since turned by more than 90 degrees.
  DeformResult solve_from(const DragState& pose, const HandleMotions& motions,
                          const Progress& progress = {}) const;

  /// Returns the linear response to `handles`, for Drag; stage "response". Solves 12 right-hand
  /// sides per handle by the 3n x 3n system, which this call factors if the options settle. If they
  /// settle and the system exceeds the memory limit, the columns are those of a DragPreview
  /// (DragResponse::why_not_exact).
  std::shared_ptr<const DragResponse> response_of(std::span<const std::size_t> handles,
                                                  const Progress& progress = {}) const;
  /// The same for all handles.
  std::shared_ptr<const DragResponse> response(const Progress& progress = {}) const;

  /// The rest stretch for these motions, as in DeformResult; empty if no handle scales.
  std::vector<Eigen::Matrix3d> rest_stretch(std::span<const Eigen::Affine3d> motions) const;

  /// Whether a solver constructed from these arguments would give the same bits.
  bool is_of(std::span<const Eigen::Vector3d> rest, const Topology& topology,
             const EditRegion& region, const DeformOptions& options, const Kernels& kernels) const;

  const EditRegion& region() const;
  const StageTimings& timings() const;
  std::string_view solver_name() const;
  std::size_t unknown_count() const;  ///< number of unknown vertices

 private:
  friend class DragSession;
  DeformSolver(std::shared_ptr<const EditSystem> edit, Kernels& kernels, const Progress& progress);
  DeformResult solved(const DragState* pose, const HandleMotions& motions,
                      const Progress& progress) const;

  std::unique_ptr<const DeformSolverState> state_;
};

}  // namespace lapwing
