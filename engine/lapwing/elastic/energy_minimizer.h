#pragma once

#include <functional>
#include <memory>
#include <span>

#include "lapwing/base/cancellation.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/elastic/minimizer_result.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// A handle with free orientation: its centre and shape are prescribed, but not its rotation. The
/// prescribed position of vertex k is `centre + R shape[k]`, where R is the rotation that minimizes
/// the weighted distance between these positions and the current ones. The gradient of E therefore
/// needs no derivative of R.
struct FreeHandle {
  std::vector<Index> vertices;         ///< vertices of the mesh that are unknowns of the system
  std::vector<Eigen::Vector3d> shape;  ///< position of each vertex relative to the centre
  /// The centre minus the rest position of each vertex. `to_centre + R shape` is thus the
  /// prescribed displacement.
  std::vector<Eigen::Vector3d> to_centre;

  bool operator==(const FreeHandle&) const = default;
};

/// The constraints and forces on a surface. All fields are per vertex of the mesh.
struct MinimizerTarget {
  /// d: prescribed displacements; 0 outside the handles. Vertices of the region that are not
  /// unknowns reach these values exactly.
  std::span<const Eigen::Vector3d> prescribed;
  /// S_i: symmetric and positive definite. If empty, all S_i are the identity.
  std::span<const Eigen::Matrix3d> rest_stretch;
  /// f: forces on the unknowns. If empty, no forces act.
  std::span<const Eigen::Vector3d> forces = {};
  /// For the vertices of these handles, the positions of FreeHandle replace `prescribed`.
  std::span<const FreeHandle> free_handles = {};
};

/// A factorized 3n x 3n matrix that preconditions L-BFGS near a pose. The n x n matrix is stiff
/// against every rotation of a ring; with this matrix alone, long limbs would need many iterations
/// to bend.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  /// Assembles and factorizes the matrix at a pose. `transforms` contains one T_i per row of the
  /// rings, `displacement` one vector per entry of RegionRings::vertices. Returns false if the
  /// matrix does not fit in memory or is not positive definite. In that case, do not call
  /// `solve_in_place`.
  virtual bool factorize(std::span<const Eigen::Matrix3d> transforms,
                         std::span<const Eigen::Vector3d> displacement) = 0;

  /// Replaces a right-hand side by the solution. The unknowns are in elimination order of the n x n
  /// system: x of all unknowns, then y, then z.
  virtual void solve_in_place(std::span<double> b) = 0;

  /// Like `solve_in_place`, but with a relative error of at most about a tenth, even if the factor
  /// is in single precision.
  virtual void solve_accurately_in_place(std::span<double> b) { solve_in_place(b); }
};

/// Minimizes the energy of a region over displacements u, v' = v + u (ENERGY.md, sections 3 and 6),
///
///     E(u) = sum_i min over R_i of om_i |L(v'_i) - R_i S_i delta_i|^2
///                                + sum_j k_ij |(v'_i - v'_j) - R_i S_i (v_i - v_j)|^2
///          + sum_held w^2 |u - d|^2 + the springs of the system - 2 sum f . u,
///
/// by L-BFGS. Each iteration solves once for a direction, first with the n x n factor and later
/// with the preconditioner. It then searches along this direction (line_search.cpp). Each trial
/// point needs a fit of the rotations and a gradient (energy_evaluation.cpp). E decreases in every
/// step, so the surface is usable whenever the budget ends the loop. An object must not be used by
/// two threads at once.
class EnergyMinimizer {
 public:
  /// `system` must be assembled with a detail length. `preconditioner` is null or belongs to the
  /// same region. Both must outlive the object. Throws InputError if an option is out of range, and
  /// GpuError if the device fails.
  EnergyMinimizer(Kernels& kernels, const LaplacianSystem& system, const SettleOptions& options,
                  Preconditioner* preconditioner = nullptr);
  ~EnergyMinimizer();
  EnergyMinimizer(EnergyMinimizer&&) noexcept;
  EnergyMinimizer& operator=(EnergyMinimizer&&) noexcept;

  /// Returns E of `u` for `target`.
  double energy(const MinimizerTarget& target, std::span<const Eigen::Vector3d> u);

  /// Minimizes E over `u`, the displacements of the whole mesh, in place. The result does not
  /// depend on earlier calls. Iterations do not allocate memory. Reports the stage "settle". If it
  /// throws Cancelled, `u` contains the last iterate.
  MinimizerResult settle(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                         const Progress& progress = {});

  /// Minimizes one frame of a drag from the predicted `u`. Uses the L-BFGS history of earlier
  /// frames, because `target` differs little from the target of the last frame. Ends when `budget`
  /// is spent.
  MinimizerResult follow(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                         const TimeBudget& budget = {}, const Progress& progress = {});

  /// Like `follow`, but uses the preconditioner, which it first factorizes at `u`. On surfaces of a
  /// few thousand vertices, this is fast enough for a frame.
  MinimizerResult follow_by_hessian(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                                    const TimeBudget& budget = {}, const Progress& progress = {});

  /// Minimizes a frame with the same `target` as the last call, starting from its result `u`. After
  /// three iterations in successive calls of this function, the next call first factorizes the
  /// preconditioner at the current pose, even if that exceeds `budget`.
  MinimizerResult follow_at_rest(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                                 const TimeBudget& budget = {}, const Progress& progress = {});

  /// Call this if the target has moved but there is no time to call `follow`. It discards the state
  /// of `follow_at_rest`, which belongs to an earlier pose.
  void end_rest();

  /// Clears the history; call this before the first frame of a drag.
  void begin_drag();

  /// Returns true if the last step was computed with the preconditioner.
  bool uses_hessian() const;

  /// Writes half of the gradient of E at the result of the last call to `gradient`, which has one
  /// vector per vertex of the mesh. Sets only the vectors of the unknowns.
  void gradient(std::span<Eigen::Vector3d> gradient) const;
  /// Returns T_i for each row of the rings, at the result of the last call.
  std::vector<Eigen::Matrix3d> transforms();
  /// Returns R for each free handle of the target, at the result of the last call.
  std::vector<Eigen::Matrix3d> handle_rotations();

 private:
  struct State;
  MinimizerResult iterate(std::span<Eigen::Vector3d> u, const TimeBudget& budget,
                          const Progress& progress);

  std::unique_ptr<State> state_;
};

}  // namespace lapwing
