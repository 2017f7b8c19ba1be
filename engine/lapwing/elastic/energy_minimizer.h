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

/// A handle whose orientation is free: its centre and shape are prescribed, its rotation is not.
/// Vertex k should go to `centre + R shape[k]`, where the rotation R fits these positions to the
/// vertices best, by the weights of the system. E measures the remaining distance, so its gradient
/// needs no derivative of R.
struct FreeHandle {
  std::vector<Index> vertices;         ///< of the mesh; unknowns of the system
  std::vector<Eigen::Vector3d> shape;  ///< per vertex, relative to the centre
  /// Per vertex: the centre minus the vertex at rest, so that `to_centre + R shape` is the
  /// displacement.
  std::vector<Eigen::Vector3d> to_centre;

  bool operator==(const FreeHandle&) const = default;
};

/// The constraints and forces on a surface. All fields are per vertex of the mesh.
struct MinimizerTarget {
  /// d: prescribed displacements; 0 off the handles. A vertex of the region that is not an unknown
  /// takes its value exactly.
  std::span<const Eigen::Vector3d> prescribed;
  /// S_i: symmetric and positive definite; the identity if empty.
  std::span<const Eigen::Matrix3d> rest_stretch;
  /// f: forces on the unknowns; none if empty.
  std::span<const Eigen::Vector3d> forces = {};
  /// At the vertices of these handles, positions fitted by rotation replace `prescribed`.
  std::span<const FreeHandle> free_handles = {};
};

/// A factored 3n x 3n matrix that preconditions L-BFGS near a pose. With only the n x n matrix,
/// which resists every rotation of a ring, long limbs take many iterations to bend.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  /// Assembles and factors the matrix at a pose. `transforms` holds one T_i per row of the rings.
  /// `displacement` has one vector per entry of RegionRings::vertices. Returns false if the matrix
  /// does not fit in memory or is not positive definite. In that case, do not call
  /// `solve_in_place`.
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
  /// depend on earlier calls. Allocates nothing per iteration. Reports stage "settle". If it throws
  /// Cancelled, `u` holds the last iterate.
  MinimizerResult settle(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                         const Progress& progress = {});

  /// Minimizes one frame of a drag from the predicted `u`. Uses the L-BFGS history of earlier
  /// frames, because `target` differs little from that of the last frame. Ends when `budget` is
  /// spent.
  MinimizerResult follow(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                         const TimeBudget& budget = {}, const Progress& progress = {});

  /// The same with the preconditioner, which this call first factors at `u`. For surfaces of a few
  /// thousand vertices, a frame has enough time for this.
  MinimizerResult follow_by_hessian(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                                    const TimeBudget& budget = {}, const Progress& progress = {});

  /// Minimizes a frame with the `target` of the last call, from its result `u`. If such calls have
  /// made three iterations in total, the next call first factors the preconditioner at the current
  /// pose, even if that exceeds `budget`.
  MinimizerResult follow_at_rest(const MinimizerTarget& target, std::span<Eigen::Vector3d> u,
                                 const TimeBudget& budget = {}, const Progress& progress = {});

  /// Call this if the target moves but the frame has no time for `follow`. The state of
  /// `follow_at_rest` then belongs to an earlier pose and must not be reused.
  void end_rest();

  /// Clears the history, so that the next frame is the first of another drag.
  void begin_drag();

  /// Returns true if the last step was computed with the preconditioner.
  bool uses_hessian() const;

  /// Writes half of the gradient of E at the surface of the last call, for the unknowns. `gradient`
  /// is per vertex of the mesh.
  void gradient(std::span<Eigen::Vector3d> gradient) const;
  /// Returns T_i per row of the rings, at the surface of the last call.
  std::vector<Eigen::Matrix3d> transforms();
  /// Returns R of each of the target's free handles, at the surface of the last call.
  std::vector<Eigen::Matrix3d> handle_rotations();

 private:
  struct State;
  MinimizerResult iterate(std::span<Eigen::Vector3d> u, const TimeBudget& budget,
                          const Progress& progress);

  std::unique_ptr<State> state_;
};

}  // namespace lapwing
