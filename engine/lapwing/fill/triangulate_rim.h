#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Triangulates the closed polygon `rim`. The triangles have the orientation of the polygon, and
/// their corners are indices into `rim`. If the polygon has at most kMostAreaVertices vertices, the
/// result has the smallest area. If several triangulations have nearly this area, the one with
/// shorter edges is preferred (Barequet and Sharir 1995; O(n^3)). Larger polygons are triangulated
/// by `triangulate_polygon`. `is_edge(a, b)` returns whether the mesh already has this edge. The
/// smallest-area triangulation avoids such diagonals if it can.
std::vector<Triangle> triangulate_rim(std::span<const Eigen::Vector3d> rim,
                                      const std::function<bool(Index, Index)>& is_edge);

inline constexpr std::size_t kMostAreaVertices = 400;

}  // namespace lapwing
