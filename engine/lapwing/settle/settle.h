#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/settle/settle_options.h"

namespace lapwing {

class Anderson;

struct SettleResult {
  int iterations = 0;      ///< global steps taken
  double last_step = 0.0;  ///< how far a vertex would still move, in mean edge lengths
  bool settled = false;    ///< last_step is within the tolerance
  double energy = 0.0;     ///< the sum below, of the result, in squared mesh units
};

/// Finds the displacements u of the region for which u is the best, in the sense of
///
///     sum_i |L(v_i + u_i) - T_i delta_i|^2  +  sum_held w^2 |u - d|^2
///       + mu/2 sum_i sum_j w_ij |(v_i + u_i) - (v_j + u_j) - T_i (v_i - v_j)|^2,
///
/// and T_i the rotation (or similarity, see Details) that fits the ring K_i in u best (eq. 6
/// restricted to rotations). Alternates the two: T for u (kernel fit_rotations), u for T (kernel
/// rotate_laplacians, then one solve with the one n x n factor that serves x, y, z and every
/// iteration), accelerated. Where the linear solution is right only for small angles, this is right
/// for any; it wants a start that is not too far, for which the linear solution serves.
///
/// One object serves one thread at a time.
class Settler {
 public:
  /// `system` must outlive the object and have been made with the weights and mu of `options`.
  /// Throws InputError for options out of range, GpuError when the device fails.
  Settler(Kernels& kernels, const LaplacianSystem& system, const SettleOptions& options);
  ~Settler();
  Settler(Settler&&) noexcept;
  Settler& operator=(Settler&&) noexcept;

  /// Settles `u`, displacements of the whole mesh, from where they are. `wanted` holds what handles
  /// ask for and 0 elsewhere; a vertex of the region that is not solved for goes there. Allocates
  /// nothing per iteration. Throws Cancelled, with `u` as far as it got, when `progress` (stage
  /// "settle") asks for it.
  SettleResult settle(std::span<const Eigen::Vector3d> wanted, std::span<Eigen::Vector3d> u,
                      const Progress& progress = {});

  /// One frame of a drag: the same for a `wanted` a little farther on than in the last call, with
  /// `u` where that one ended and moved on by the linear response to what `wanted` did since
  /// (without that it can take longer than settling anew, and end elsewhere). What its iterations
  /// told of the slow ways to move is kept from frame to frame, more of it than `settle` keeps: a
  /// third of the iterations. The first call takes the memory for it, 600 bytes an unknown vertex;
  /// later ones allocate nothing per iteration. The result depends, within the tolerance, on the
  /// frames since `begin_drag`.
  SettleResult follow(std::span<const Eigen::Vector3d> wanted, std::span<Eigen::Vector3d> u,
                      const Progress& progress = {});

  /// Forgets the frames so far: the next one is the first of another drag.
  void begin_drag();

 private:
  struct State;
  SettleResult iterate(Anderson& anderson, std::span<Eigen::Vector3d> u, const Progress& progress);

  std::unique_ptr<State> state_;
};

}  // namespace lapwing
