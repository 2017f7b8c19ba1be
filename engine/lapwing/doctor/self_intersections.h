#pragma once

#include <array>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns the pairs of triangles that intersect or touch apart from shared corners and edges, or
/// that share an edge and overlap. Each pair has its lower index first, and pairs are ascending.
/// Skips triangles with zero area or with a corner that is not finite. Signs of volumes are
/// computed with an error bound in long double. If a sign is uncertain, within about 1e-18 of the
/// size, the triangles count as touching. O(n log n) if no triangle overlaps many others. Throws
/// InputError if more than kMostPairs pairs of bounding boxes overlap, for example in a fan of
/// 10,000 triangles. Throws Cancelled.
std::vector<std::array<Index, 2>> self_intersections(std::span<const Triangle> triangles,
                                                     std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
