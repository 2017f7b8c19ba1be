#pragma once

#include <functional>
#include <memory>
#include <span>

#include "lapwing/base/progress.h"
#include "lapwing/elastic/minimizer_result.h"
#include "lapwing/elastic/settle_options.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// A handle whose orientation is free: its centre and its shape are prescribed, and it turns as the
/// surface wants. Vertex k should go to `centre + R shape[k]`, where R is the rotation that brings
/// these places nearest to the vertices, by the weights of the system. E counts the distance that
/// remains, so its gradient needs no derivative of R.
struct FreeHandle {
  std::vector<Index> vertices;         ///< of the mesh; unknowns of the system
  std::vector<Eigen::Vector3d> shape;  ///< per vertex, relative to the centre
  /// Per vertex: the centre minus the vertex at rest, so that `to_centre + R shape` is the
  /// displacement.
  std::vector<Eigen::Vector3d> to_centre;

  bool operator==(const FreeHandle&) const = default;
};

/// What is asked of a surface. All fields are per vertex of the mesh.
struct MinimizerTarget {
  /// d: prescribed displacements; 0 off the handles. A vertex of the region that is not an unknown
  /// goes there.
  std::span<const Eigen::Vector3d> wanted;
  /// S_i: symmetric and positive definite; the identity if empty.
  std::span<const Eigen::Matrix3d> rest_stretch;
  /// f: forces on the unknowns; none if empty.
  std::span<const Eigen::Vector3d> forces = {};
  /// Their places replace `wanted` at their vertices.
  std::span<const FreeHandle> free_handles = {};
};

/// A preconditioner for L-BFGS at a pose. The n x n matrix resists every rotation of a ring, so
/// long limbs bend slowly with it. A factorization of a 3n x 3n matrix saves most of these
/// iterations.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  /// Assembles and factors at a pose. `transforms` are T_i per row of the rings, as RingRotations
  /// has them, `displacement` one vector for each of RegionRings::vertices. Returns false, and
  /// cannot solve then, if it does not fit in memory or is not positive definite.
  virtual bool factorize(std::span<const Eigen::Matrix3d> transforms,
                         std::span<const Eigen::Vector3d> displacement) = 0;

  /// Replaces a right-hand side by its solution, in the order of elimination of the n x n system: x
  /// of all unknowns, then y, then z.
  virtual void solve_in_place(std::span<double> b) = 0;

  /// The same with an error of about a tenth, even if the factor is held in single precision.
  virtual void solve_accurately_in_place(std::span<double> b) { solve_in_place(b); }
};

/// Minimizes the energy of a region over displacements u, v' = v + u (ENERGY.md, sections 3 and 6),
///
///     E(u) = sum_i min over R_i of om_i |L(v'_i) - R_i S_i delta_i|^2
///                                + sum_j k_ij |(v'_i - v'_j) - R_i S_i (v_i - v_j)|^2
///          + sum_held w^2 |u - d|^2 + the springs of the system - 2 sum f . u,
///
/// by L-BFGS. Each iteration solves once for a direction, at first with the n x n factor, then with
/// the preconditioner, and searches along it. Each trial point costs a fit of the rotations (kernel
/// fit_rotations) and a gradient (kernel energy_gradient). A trial point by the preconditioner is
/// corrected by one more solve with the n x n factor. E falls with every step, so the surface is
/// usable whenever the budget ends the loop. One object serves one thread at a time.
class EnergyMinimizer {
 public:
  /// `system` must outlive the object and have been assembled with a detail length; so must
  /// `preconditioner`, of the same region, which may be null. Throws InputError for options out of
  /// range, GpuError if the device fails.
  EnergyMinimizer(Kernels& kernels, const LaplacianSystem& system, const SettleOptions& options,
                  Preconditioner* preconditioner = nullptr);
  ~EnergyMinimizer();
  EnergyMinimizer(EnergyMinimizer&&) noexcept;
  EnergyMinimizer& operator=(EnergyMinimizer&&) noexcept;

  /// E of `u` for `target`, without moving it.
  double energy(const MinimizerTarget& target, std::span<const Eigen::Vector3d> u);

  /// Minimizes from `u`, displacements of the whole mesh, in place. The result depends on nothing
  /// that was minimized before. Allocates nothing per iteration. Throws Cancelled, with `u` as far
  /// as it got, if `progress` (stage "settle") asks for it.
  MinimizerResult settle(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                         const Progress& progress = {});

  /// One frame of a drag: the same for a `target` a little farther on than in the last call, from
  /// the predicted `u`. Keeps the L-BFGS history from frame to frame. Ends when `budget` says no.
  MinimizerResult follow(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                         const TimeBudget& budget = {}, const Progress& progress = {});

  /// The same with the preconditioner, which is factored at `u` first. Meant for surfaces of a few
  /// thousand vertices, where that fits into a frame.
  MinimizerResult follow_by_hessian(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                                    const TimeBudget& budget = {}, const Progress& progress = {});

  /// A frame whose `target` is still that of the last call, with `u` where that ended. After three
  /// iterations of such frames the preconditioner is factored at the pose. A factorization starts
  /// a call: `budget` is asked for the iteration, not for the factorization before it.
  MinimizerResult follow_at_rest(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                                 const TimeBudget& budget = {}, const Progress& progress = {});

  /// Says that the target moves on in a frame without time for `follow`: what `follow_at_rest` has
  /// counted and factored belongs to another pose.
  void end_rest();

  /// Clears the history of the frames: the next one is the first of another drag.
  void begin_drag();

  /// Whether the last step came from the preconditioner.
  bool uses_hessian() const;

  /// Half of the gradient of E at the surface of the last call, for the unknowns; `gradient` is per
  /// vertex of the mesh.
  void gradient(std::span<Eigen::Vector3d> gradient) const;
  /// T_i per row of the rings there.
  std::vector<Eigen::Matrix3d> transforms();
  /// R of each of the target's free handles there.
  std::vector<Eigen::Matrix3d> handle_rotations();

 private:
  struct State;
  MinimizerResult iterate(std::span<Eigen::Vector3d> u, const TimeBudget& budget,
                          const Progress& progress);

  std::unique_ptr<State> state_;
};

}  // namespace lapwing
