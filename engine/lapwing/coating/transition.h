#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/patch/patch.h"

namespace lapwing {

/// How something new fades in from the border of a patch to its inside.
struct Transition {
  enum class Profile {
    smooth,  ///< 3 x^2 - 2 x^3: no kink at either end
    linear,
  };
  double width = 0.0;  ///< geodesic distance from the border to where it is all there; 0: a step
  Profile profile = Profile::smooth;
  bool operator==(const Transition&) const = default;
};

/// The share that is there at distance `distance` from the border, 0 to 1; 1 everywhere without a
/// width.
double fade(const Transition& transition, double distance);

/// The share at each vertex of the patch (PATCH vertices in their own numbers, midpoints left out),
/// by geodesic distance from its boundary loop within the patch.
std::vector<double> fades(const Transition& transition, const Patch& patch,
                          const Topology& topology, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
