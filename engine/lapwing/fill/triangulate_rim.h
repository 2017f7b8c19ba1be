#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Triangulates the closed polygon `rim` with its orientation. Corners are positions in `rim`. If
/// the polygon has at most kMostAreaVertices vertices, the result has the smallest area. Of several
/// results with this area, it has short edges (Barequet and Sharir 1995; O(n^3)). A longer polygon
/// is cut as by `triangulate_polygon`. `is_edge(a, b)` returns whether the mesh already has this
/// edge. The triangulation avoids such diagonals if it can.
std::vector<Triangle> triangulate_rim(std::span<const Eigen::Vector3d> rim,
                                      const std::function<bool(Index, Index)>& is_edge);

inline constexpr std::size_t kMostAreaVertices = 400;

}  // namespace lapwing
