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
/// The solver is immutable, so several threads may call its members. `topology` and `kernels` must
/// outlive it. With settling, it takes about 4 kB per vertex, and 8 kB after the first
/// minimization. Without settling, it takes 8 kB per vertex.
class DeformSolver {
 public:
  /// Factors the n x n system and, without settling, the 3n x 3n system (LinearResponse). Reports
  /// the stages "pattern", "order" and "laplacian". Without settling, "assemble", "analyze",
  /// "normal_matrix" and "factor" follow. The last stage is "shares". Throws InputError for a
  /// region that does not fit the mesh. Throws SolverError if a component is not anchored or memory
  /// is short. Also throws GpuError and Cancelled.
  DeformSolver(std::span<const Eigen::Vector3d> rest, const Topology& topology, EditRegion region,
               const DeformOptions& options, Kernels& kernels, const Progress& progress = {});

  /// Reuses the data in `prepared`; results have the same bits as without reuse. The stage
  /// "constraints" replaces "pattern" and "order". Stages without work are not reported.
  DeformSolver(PreparedRegion& prepared, std::span<const Eigen::Vector3d> rest, EditRegion region,
               const DeformOptions& options, Kernels& kernels, const Progress& progress = {});

  /// Shares the prepared edit of `preview`. This constructor may run on another thread while a drag
  /// uses `preview`.
  DeformSolver(const DragPreview& preview, Kernels& kernels, const Progress& progress = {});
  ~DeformSolver();
  DeformSolver(DeformSolver&&) noexcept;
  DeformSolver& operator=(DeformSolver&&) noexcept;

  /// Returns the surface for one motion per handle, with its certificate. Reports stage "settle" if
  /// the options settle. Identity motions return the rest positions bit for bit. Throws InputError
  /// if the number of motions is wrong or a motion is too far. Throws SolverError if the
  /// certificate does not hold. Also throws Cancelled.
  DeformResult solve(std::span<const Eigen::Affine3d> motions, const Progress& progress = {}) const;

  /// The same for accumulated turns. The surface winds with its handles, as far as it can keep the
  /// winding. Free orientations require settling with soft constraints.
  DeformResult solve(const HandleMotions& motions, const Progress& progress = {}) const;

  /// Minimizes at each motion of `path` in turn and then at `motions`, each from the previous
  /// minimum. Far motions have several minima; the path decides which one is found. Large regions
  /// follow the path on their coarse proxy. If a handle turns by more than 90 degrees to the next
  /// motion, that minimization starts from rest again.
  DeformResult solve_along(std::span<const HandleMotions> path, const HandleMotions& motions,
                           const Progress& progress = {}) const;

  /// Starts from a pose of this region (DragSession::state), so that the result is the minimum near
  /// the drag's last frame. Ignores the pose if it is empty, if the options do not settle, or if a
  /// handle has turned by more than 90 degrees since then.
  DeformResult solve_from(const DragState& pose, const HandleMotions& motions,
                          const Progress& progress = {}) const;

  /// Returns the linear response to `handles`, for Drag. Reports stage "response". Solves 12
  /// right-hand sides per handle with the 3n x 3n system. If the options settle, this call factors
  /// that system. If the system then exceeds the memory limit, the columns are those of a
  /// DragPreview (DragResponse::why_not_exact).
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
