#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing::zipping {

/// A place in the host's loop and one in the part's.
using Pair = std::array<Index, 2>;

/// Pairs of vertices of two closed curves that run the same way, each the other's nearest and
/// nearer than `share` times the shortest of the four edges at them; as many as both orders allow,
/// by place in `host`, their places in `part` ascending but for one step over its end. Near-linear
/// where the curves do not crowd.
std::vector<Pair> weld_loops(std::span<const Eigen::Vector3d> host,
                             std::span<const Eigen::Vector3d> part, double share);

/// The places of the two closest vertices; of equally close ones the first.
Pair closest_pair(std::span<const Eigen::Vector3d> host, std::span<const Eigen::Vector3d> part);

}  // namespace lapwing::zipping
