#pragma once

#include <functional>

namespace lapwing {

/// How a minimization of the energy ended.
struct MinimizerResult {
  int iterations = 0;  ///< number of steps, without the final step of a settled surface
  /// The largest displacement of a vertex in the last full step, before the line search; in mean
  /// edge lengths.
  double last_step = 0.0;
  bool settled = false;    ///< `last_step` is at most the tolerance
  bool exhausted = false;  ///< no step lowers E by more than rounding errors
  /// The Hessian did not fit in memory or could not be factorized. Large regions then settle
  /// slowly.
  bool lacks_hessian = false;
  double energy = 0.0;  ///< E at the result, in squared mesh units
  /// |grad E| / |force of the handles|: the norm of the gradient of E with respect to the unknowns,
  /// divided by the norm of the gradient of the constraint terms. It is 0 if the constraints exert
  /// no force.
  double relative_gradient = 0.0;
};

/// Returns true if there is time for another iteration that takes about `ms`. `ms` is 0 if the
/// duration is unknown, and before the first iteration of a frame that must run at least one. The
/// function must then return true.
using TimeBudget = std::function<bool(double ms)>;

}  // namespace lapwing
