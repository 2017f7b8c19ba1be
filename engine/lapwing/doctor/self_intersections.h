#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Pairs of triangles that have more in common than the corners and the edge that they share: they
/// cut through each other, touch, or, where they share an edge, lie on each other. Each pair lower
/// number first, all ascending; triangles without area, or with a corner that is not finite, are
/// left out. Signs of volumes are decided with an error bound in long double; what is not decided
/// there, within about 1e-18 of the size, counts as touching. O(n log n) for n triangles of which
/// none overlaps many. Throws InputError when more than kMostPairs of boxes overlap, as of fans of
/// 10,000 triangles or as many copies of one; Cancelled.
std::vector<std::array<Index, 2>> self_intersections(std::span<const Triangle> triangles,
                                                     std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
