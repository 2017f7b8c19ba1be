#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns the pairs of triangles that intersect or touch apart from shared corners and edges, or
/// that share an edge and overlap. Each pair has its lower number first, and pairs are ascending.
/// Skips triangles without area or with a corner that is not finite. The signs of volumes are
/// decided with an error bound in long double. If a sign stays undecided, within about 1e-18 of the
/// size, the triangles count as touching. O(n log n) if no triangle overlaps many others. Throws
/// InputError if more than kMostPairs pairs of boxes overlap, as in a fan of 10,000 triangles or as
/// many copies of one. Throws Cancelled.
std::vector<std::array<Index, 2>> self_intersections(std::span<const Triangle> triangles,
                                                     std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
