#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"
#include "lapwing/patch/patch.h"
#include "lapwing/region/transition.h"

namespace lapwing {

/// How something new fades in from the border of a patch: the share at each vertex of the patch
/// (PATCH vertices in their own numbers, midpoints left out), by geodesic distance from its
/// boundary loop within the patch.
std::vector<double> fades(const Transition& transition, const Patch& patch,
                          const Topology& topology, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
