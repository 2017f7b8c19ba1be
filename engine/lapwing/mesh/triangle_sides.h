#pragma once

#include <span>

#include "lapwing/mesh/topology.h"

namespace lapwing {

// Side 3 t + k of a list of triangles goes from corner k of triangle t to the next one.

inline Index side_start(std::span<const Triangle> triangles, Index side) {
  return triangles[side / 3][side % 3];
}
inline Index side_end(std::span<const Triangle> triangles, Index side) {
  return triangles[side / 3][(side + 1) % 3];
}

/// Returns the sides on each edge, ascending. Edges are sorted by their lower vertex, then by the
/// other. Near-linear time. No triangle may use a vertex twice.
Adjacency sides_by_edge(std::span<const Triangle> triangles, std::size_t vertex_count);

}  // namespace lapwing
