#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/settle/settle_options.h"

namespace lapwing {

struct SettleResult {
  int iterations = 0;      ///< global steps taken
  double last_step = 0.0;  ///< how far a vertex would still move, in mean edge lengths
  bool settled = false;    ///< last_step is within the tolerance
  double energy = 0.0;     ///< of the result, in squared mesh units
};

/// Minimizes, over displacements u of the region and one rotation R_i (or similarity, see Details)
/// for each ring,
///
///     sum_i |L(v_i + u_i) - R_i delta_i|^2  +  sum_held w^2 |u - d|^2
///       + mu/2 sum_i sum_j w_ij |(v_i + u_i) - (v_j + u_j) - R_i (v_i - v_j)|^2
///
/// by alternating the best R_i for u (eq. 6 restricted to rotations) with the best u for R: one
/// factor of (L'L + W + mu K), n x n, serves x, y, z and every iteration. Where the linear solution
/// is right only for small angles, this is right for any; it wants a start that is not too far, for
/// which the linear solution serves.
///
/// `topology` and `constraints` must outlive the object; positions are copied. One object serves
/// one thread at a time.
class Settler {
 public:
  /// Prepares and factors; stages "settle_matrix" and "settle_factor". Throws InputError for
  /// options out of range and SolverError, naming the vertex, where a component is not held.
  Settler(std::span<const Eigen::Vector3d> rest, const Topology& topology,
          std::span<const Index> roi, const Constraints& constraints, const SettleOptions& options,
          const Progress& progress, StageTimings& timings);
  ~Settler();
  Settler(Settler&&) noexcept;
  Settler& operator=(Settler&&) noexcept;

  /// Settles `u`, displacements of the whole mesh, from where they are. `wanted` holds what handles
  /// ask for and 0 elsewhere. Allocates nothing. Throws Cancelled, with `u` as far as it got, when
  /// `progress` (stage "settle") asks for it.
  SettleResult settle(std::span<const Eigen::Vector3d> wanted, std::span<Eigen::Vector3d> u,
                      const Progress& progress = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lapwing
