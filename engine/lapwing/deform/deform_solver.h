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
  /// Of the whole mesh; bitwise equal to the rest position if a vertex does not move.
  Positions positions;
  Certificate certificate;
  /// The prescribed rest stretch S_i (rest_stretch.h), per vertex of the mesh. Empty if all S_i are
  /// the identity.
  std::vector<Eigen::Matrix3d> rest_stretch = {};
  /// The requested motions. For a handle with free orientation, the rotation is that of the
  /// minimum.
  HandleMotions motions = {};
};

/// A region prepared for many solutions: detail-preserving deformation by affine motions of its
/// handles (paper, sections 3 and 4; ENERGY.md section 3).
///
///     DeformSolver solver(mesh.positions, topology, region, {}, kernels);
///     mesh.positions = solver.solve(motions).positions;
///
/// The solver is immutable, so several threads may call its members. `topology` and `kernels` must
/// outlive it. With settling, the solver takes about 4 kB per vertex before the first minimization
/// and 8 kB after it. Without settling, it takes 8 kB per vertex.
class DeformSolver {
 public:
  /// Factorizes the n x n system and, without settling, the 3n x 3n system (LinearResponse).
  /// Reports the stages "pattern", "order" and "laplacian". Without settling, "assemble",
  /// "analyze", "normal_matrix" and "factor" follow. The last stage is "shares". Throws InputError
  /// for a region that does not fit the mesh. Throws SolverError if a component is not anchored or
  /// the memory does not suffice. Also throws GpuError and Cancelled.
  DeformSolver(std::span<const Eigen::Vector3d> rest, const Topology& topology, EditRegion region,
               const DeformOptions& options, Kernels& kernels, const Progress& progress = {});

  /// Reuses the data in `prepared`. The results are bitwise identical to those without reuse. The
  /// stage "constraints" replaces "pattern" and "order". Stages that have nothing to do are not
  /// reported.
  DeformSolver(PreparedRegion& prepared, std::span<const Eigen::Vector3d> rest, EditRegion region,
               const DeformOptions& options, Kernels& kernels, const Progress& progress = {});

  /// Shares the data that `preview` has prepared. This constructor may run on another thread while
  /// a drag uses `preview`.
  DeformSolver(const DragPreview& preview, Kernels& kernels, const Progress& progress = {});
  ~DeformSolver();
  DeformSolver(DeformSolver&&) noexcept;
  DeformSolver& operator=(DeformSolver&&) noexcept;

  /// Returns the surface for one motion per handle, with its certificate. With settling, reports
  /// the stage "settle". If all motions are the identity, returns exactly the rest positions.
  /// Throws InputError if the number of motions is wrong or a motion is too large. Throws
  /// SolverError if the result is invalid (require_valid). Also throws Cancelled.
  DeformResult solve(std::span<const Eigen::Affine3d> motions, const Progress& progress = {}) const;

  /// Like `solve` above, for accumulated turns, which may exceed 180 degrees. The surface winds
  /// with its handles, up to the largest stable winding. Handles with free orientation require
  /// settling with soft constraints.
  DeformResult solve(const HandleMotions& motions, const Progress& progress = {}) const;

  /// Minimizes for each entry of `path` in order and then for `motions`. Each minimization starts
  /// from the previous minimum. For large motions, the energy has several minima, and the path
  /// determines which one is found. Large regions follow the path on their coarse proxy. If a
  /// handle turns by more than 90 degrees from one entry to the next, the minimization for the next
  /// entry starts from rest.
  DeformResult solve_along(std::span<const HandleMotions> path, const HandleMotions& motions,
                           const Progress& progress = {}) const;

  /// Starts the minimization from a pose of this region (DragSession::state), so that the result is
  /// the minimum near the last frame of the drag. Ignores the pose if it is empty, if the options
  /// do not settle, or if a handle has turned by more than 90 degrees since that pose.
  DeformResult solve_from(const DragState& pose, const HandleMotions& motions,
                          const Progress& progress = {}) const;

  /// Returns the linear response to `handles`, for Drag. Solves 12 right-hand sides per handle with
  /// the 3n x 3n system. With settling, this call first factorizes that system. If the system
  /// exceeds the memory limit, the columns are those of a DragPreview
  /// (DragResponse::why_not_exact). Reports stage "response".
  std::shared_ptr<const DragResponse> response_of(std::span<const std::size_t> handles,
                                                  const Progress& progress = {}) const;
  /// Returns the linear response to all handles.
  std::shared_ptr<const DragResponse> response(const Progress& progress = {}) const;

  /// Returns the rest stretch for these motions (DeformResult::rest_stretch); empty if no handle
  /// scales.
  std::vector<Eigen::Matrix3d> rest_stretch(std::span<const Eigen::Affine3d> motions) const;

  /// Returns true if a solver constructed from these arguments would give bitwise identical
  /// results.
  bool is_of(std::span<const Eigen::Vector3d> rest, const Topology& topology,
             const EditRegion& region, const DeformOptions& options, const Kernels& kernels) const;

  const EditRegion& region() const;
  const StageTimings& timings() const;
  std::string_view solver_name() const;
  std::size_t unknown_count() const;  ///< number of unknown vertices

 private:
  friend class DragSession;
  friend class ProxyDrag;
  DeformSolver(std::shared_ptr<const EditSystem> edit, Kernels& kernels, const Progress& progress);
  DeformResult solved(const DragState* pose, const HandleMotions& motions,
                      const Progress& progress) const;

  std::unique_ptr<const DeformSolverState> state_;
};

}  // namespace lapwing
