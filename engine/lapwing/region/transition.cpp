#include "lapwing/region/transition.h"

#include <algorithm>

namespace lapwing {

double fade(const Transition& transition, double distance) {
  if (transition.width <= 0.0) return 1.0;
  const double x = std::clamp(distance / transition.width, 0.0, 1.0);
  return transition.profile == Transition::Profile::linear ? x : x * x * (3.0 - 2.0 * x);
}

}  // namespace lapwing
