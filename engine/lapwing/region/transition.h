#pragma once

#include <algorithm>

namespace lapwing {

/// A ramp from 0 to 1 over a distance.
struct Transition {
  enum class Profile {
    smooth,  ///< 3 x^2 - 2 x^3, with zero slope at both ends
    linear,
  };
  double width = 0.0;  ///< geodesic distance over which the ramp increases; 0 is a step
  Profile profile = Profile::smooth;
  bool operator==(const Transition&) const = default;
};

/// Returns the value of the ramp, 0 to 1, at `distance` from its start, or 1 if the width is 0.
inline double fade(const Transition& transition, double distance) {
  if (transition.width <= 0.0) return 1.0;
  const double x = std::clamp(distance / transition.width, 0.0, 1.0);
  return transition.profile == Transition::Profile::linear ? x : x * x * (3.0 - 2.0 * x);
}

}  // namespace lapwing
