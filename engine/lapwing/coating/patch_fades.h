#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/patch/patch.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// Returns the share of `transition` at each vertex of `patch`, midpoints excepted, by the geodesic
/// distance within the patch from its boundary loop.
std::vector<double> fades(const Transition& transition, const Patch& patch,
                          const Topology& topology, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
