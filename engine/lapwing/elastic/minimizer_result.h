#pragma once

#include <functional>

namespace lapwing {

/// How a minimization of the energy ended.
struct MinimizerResult {
  int iterations = 0;  ///< steps taken, except the final one of a settled surface
  /// The length of the last full step, before the line search, at the vertex that it moves
  /// farthest; in mean edge lengths.
  double last_step = 0.0;
  bool settled = false;    ///< last_step is within the tolerance
  bool exhausted = false;  ///< no step lowers E by more than rounding
  /// The Hessian did not fit in memory, or could not be factored: large regions settle slowly then.
  bool lacks_hessian = false;
  double energy = 0.0;  ///< E at the result, in squared mesh units
  /// |grad E| / |force of the handles|: the norm of the gradient of E with respect to the unknowns,
  /// divided by that of the constraint terms alone. It is 0 if the constraints exert no force.
  double relative_gradient = 0.0;
};

/// Returns whether there is time for another iteration of about `ms`. `ms` is 0 if the duration is
/// unknown, and for the first iteration of a frame that needs at least one. Return true then.
using TimeBudget = std::function<bool(double ms)>;

}  // namespace lapwing
