#pragma once

#include <functional>
#include <memory>
#include <span>

#include "lapwing/base/progress.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/settle/settle_options.h"

namespace lapwing {

struct SettleResult {
  int iterations = 0;      ///< steps taken, each by one solve
  double last_step = 0.0;  ///< of the vertex that moved farthest, in mean edge lengths
  bool settled = false;    ///< last_step is within the tolerance
  bool exhausted = false;  ///< no step lowers E by more than rounding
  double energy = 0.0;     ///< E of the result, in squared mesh units
  /// |grad E| over |force of the handles|: the gradient of E by the unknowns, over that of its last
  /// sum alone; 0 where nothing pulls.
  double relative_gradient = 0.0;
};

/// A handle whose orientation is free: its centre and its shape are prescribed, and it turns as the
/// surface wants. Vertex k should go to `centre + R shape[k]`, where R is the rotation that brings
/// these places nearest to the vertices, weighted as the system holds them. E counts the distance
/// that remains, so its gradient needs no derivative of R.
struct FreeHandle {
  std::vector<Index> vertices;         ///< of the mesh; unknowns of the system
  std::vector<Eigen::Vector3d> shape;  ///< per vertex, relative to the centre
  /// Per vertex: the centre minus the vertex at rest, so that `to_centre + R shape` is the
  /// displacement.
  std::vector<Eigen::Vector3d> to_centre;

  bool operator==(const FreeHandle&) const = default;
};

/// What handles ask of a surface.
struct SettleTarget {
  /// d: per vertex of the mesh; 0 off the handles. A vertex of the region that is not solved for
  /// goes there.
  std::span<const Eigen::Vector3d> wanted;
  /// S_i: per vertex of the mesh, symmetric and positive definite; the identity if empty.
  std::span<const Eigen::Matrix3d> rest_stretch;
  /// f: per vertex of the mesh, what pulls on the unknowns besides; none where empty.
  std::span<const Eigen::Vector3d> forces = {};
  /// What these say of their vertices replaces `wanted`.
  std::span<const FreeHandle> free_handles = {};
};

/// Asked before each iteration, which takes about `ms` (0 where that is not known, or where a frame
/// cannot do without): whether there is time to go on.
using GoOn = std::function<bool(double ms)>;

/// The second derivatives of the energy where its rings have turned: a solver that knows how limbs
/// bend, where the n x n factor holds every ring in its turn. Costs a factorization of the 3n x 3n
/// system for every pose, and saves most of the iterations where these are many.
class TurnedTangent {
 public:
  virtual ~TurnedTangent() = default;

  /// Makes it that of the pose whose rings have turned by T_i, per row of the rings as
  /// RingRotations::transforms gives them, at `displacement`, one vector for each of
  /// RegionRings::vertices. False, and nothing to solve with, where it does not fit in memory or
  /// cannot be factored.
  virtual bool turn(std::span<const Eigen::Matrix3d> transforms,
                    std::span<const Eigen::Vector3d> displacement) = 0;

  /// Replaces a right-hand side by its solution, in the order of elimination of the n x n system: x
  /// of all unknowns, then y, then z.
  virtual void solve_in_place(std::span<double> b) = 0;

  /// To about a tenth, where a factor alone may be too stiff: what settling ends by.
  virtual void solve_well_in_place(std::span<double> b) { solve_in_place(b); }
};

/// Finds displacements u of a region, v' = v + u, that make least, at least in their surroundings,
///
///     E(u) = sum_i min over R_i of om_i |L(v'_i) - R_i S_i delta_i|^2
///                                + sum_j k_ij |(v'_i - v'_j) - R_i S_i (v_i - v_j)|^2
///          + sum_held w^2 |u - d|^2 + the springs of the system - 2 sum f . u
///
/// (EnergyWeights, ENERGY.md section 3), by L-BFGS: each step takes the rotations (kernel
/// fit_rotations), the gradient (kernel energy_gradient) and one solve, at first with the one n x n
/// factor that serves x, y, z and every iteration, then with the tangent of the pose reached,
/// renewed every few iterations. E falls with every step, so that what is there at any moment is
/// the best surface so far.
///
/// One object serves one thread at a time.
class Settler {
 public:
  /// `system` must outlive the object and have been assembled with a detail length; so must
  /// `tangent`, of the same region, which may be null. Throws InputError for options out of range,
  /// GpuError when the device fails.
  Settler(Kernels& kernels, const LaplacianSystem& system, const SettleOptions& options,
          TurnedTangent* tangent = nullptr);
  ~Settler();
  Settler(Settler&&) noexcept;
  Settler& operator=(Settler&&) noexcept;

  /// E of `u` for `target`, without moving it.
  double energy(const SettleTarget& target, std::span<const Eigen::Vector3d> u);

  /// Settles `u`, displacements of the whole mesh, from where they are. Allocates nothing per
  /// iteration. Throws Cancelled, with `u` as far as it got, when `progress` (stage "settle") asks
  /// for it.
  SettleResult settle(const SettleTarget& target, std::span<Eigen::Vector3d> u,
                      const Progress& progress = {});

  /// One frame of a drag: the same for a `target` a little farther on than in the last call, with
  /// `u` where that one ended and moved on by the response to what the target did since. What its
  /// steps told of the energy is kept from frame to frame. Where
  /// `go_on`, if given, says no the result is what is there, settled or not.
  SettleResult follow(const SettleTarget& target, std::span<Eigen::Vector3d> u,
                      const GoOn& go_on = {}, const Progress& progress = {});

  /// A frame whose `target` is still that of the last call, of `follow` or of this, with `u` where
  /// that ended. After a few iterations, of all such frames together, it goes by the tangent of the
  /// pose: where that is to be renewed a call begins with it, whatever `go_on` says, and takes a
  /// factorization longer.
  SettleResult rest(const SettleTarget& target, std::span<Eigen::Vector3d> u,
                    const GoOn& go_on = {}, const Progress& progress = {});

  /// Says that the target moves on in a frame that has no time for `follow`: what `rest` has
  /// counted, and its tangent, are of another pose.
  void end_rest();

  /// Forgets the frames so far: the next one is the first of another drag.
  void begin_drag();

  /// Whether the last step went by the tangent of a pose.
  bool goes_by_tangent() const;

  /// Half of the gradient of E, and T_i per row of the rings, where the last call of any of these
  /// ended. `gradient` is per vertex of the mesh and gets those of the unknowns.
  void gradient(std::span<Eigen::Vector3d> gradient) const;
  std::vector<Eigen::Matrix3d> transforms();

  /// R of each of the target's free handles, there.
  std::vector<Eigen::Matrix3d> handle_rotations();

 private:
  struct State;
  SettleResult iterate(std::span<Eigen::Vector3d> u, const GoOn& go_on, const Progress& progress);

  std::unique_ptr<State> state_;
};

}  // namespace lapwing
