#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing::bridging {

/// A position in the host's loop and a position in the part's loop.
using Pair = std::array<Index, 2>;

/// Returns the pairs of vertices to weld on two closed curves with the same direction. The two
/// vertices of a pair are each other's nearest vertex, and nearer than `share` times the shortest
/// of their four edges. As many of these pairs as possible are returned in the same cyclic order on
/// both curves, ascending by position in `host`. Near-linear if few vertices have similar
/// coordinates.
std::vector<Pair> weld_loops(std::span<const Eigen::Vector3d> host,
                             std::span<const Eigen::Vector3d> part, double share);

/// Returns the positions of the two closest vertices, or of the first such pair.
Pair closest_pair(std::span<const Eigen::Vector3d> host, std::span<const Eigen::Vector3d> part);

}  // namespace lapwing::bridging
