#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing::bridging {

/// A place in the host's loop and one in the part's.
using Pair = std::array<Index, 2>;

/// Returns the pairs of vertices to weld on two closed curves that run the same way. The two
/// vertices are each other's nearest, and nearer than `share` times the shortest of the four edges
/// at them. The pairs are in ascending order of their places in `host`. Their places in `part`
/// wrap around at most once. As many pairs are kept as this order allows. Near-linear if the curves
/// are not crowded.
std::vector<Pair> weld_loops(std::span<const Eigen::Vector3d> host,
                             std::span<const Eigen::Vector3d> part, double share);

/// Returns the places of the two closest vertices, the first of equally close ones.
Pair closest_pair(std::span<const Eigen::Vector3d> host, std::span<const Eigen::Vector3d> part);

}  // namespace lapwing::bridging
