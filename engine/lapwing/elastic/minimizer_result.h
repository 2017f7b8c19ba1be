#pragma once

#include <functional>

namespace lapwing {

/// How a minimization of the energy ended.
struct MinimizerResult {
  int iterations = 0;      ///< steps taken, each by one solve
  double last_step = 0.0;  ///< of the vertex that moved farthest, in mean edge lengths
  bool settled = false;    ///< last_step is within the tolerance
  bool exhausted = false;  ///< no step lowers E by more than rounding
  double energy = 0.0;     ///< E of the result, in squared mesh units
  /// |grad E| over |force of the handles|: the gradient of E by the unknowns, over that of the
  /// constraints alone; 0 if nothing pulls.
  double relative_gradient = 0.0;
};

/// Asked before each iteration, which takes about `ms`, whether there is time for it. `ms` is 0 if
/// the time is not known, and for an iteration that a frame cannot do without.
using TimeBudget = std::function<bool(double ms)>;

}  // namespace lapwing
