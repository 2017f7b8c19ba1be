#pragma once

namespace lapwing {

/// How something goes from nothing to all of it over a distance.
struct Transition {
  enum class Profile {
    smooth,  ///< 3 x^2 - 2 x^3: no kink at either end
    linear,
  };
  double width = 0.0;  ///< geodesic, from where it begins to where it is all there; 0: a step
  Profile profile = Profile::smooth;
  bool operator==(const Transition&) const = default;
};

/// The share that is there at distance `distance` from where it begins, 0 to 1; 1 everywhere
/// without a width.
double fade(const Transition& transition, double distance);

}  // namespace lapwing
