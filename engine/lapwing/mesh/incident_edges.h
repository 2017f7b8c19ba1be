#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The corners of a triangle after and before the one at `v`.
inline Index next_corner(const Triangle& triangle, Index v) {
  if (triangle[0] == v) return triangle[1];
  return triangle[1] == v ? triangle[2] : triangle[0];
}
inline Index last_corner(const Triangle& triangle, Index v) {
  if (triangle[0] == v) return triangle[2];
  return triangle[1] == v ? triangle[0] : triangle[1];
}

/// An edge from a vertex v to `to`. Counts the triangles in which `to` is the corner after v, and
/// those in which it is the corner before v.
struct IncidentEdge {
  Index to = kNoIndex;
  std::size_t as_next = 0;
  std::size_t as_last = 0;

  std::size_t triangles() const { return as_next + as_last; }
  bool is_plain() const { return as_next == 1 && as_last == 1; }
};

/// Returns the spokes of `v`, ascending by `to`. `around` lists the triangles at `v`.
std::vector<IncidentEdge> incident_edges(Index v, std::span<const Index> around,
                                         std::span<const Triangle> triangles);

/// Returns whether all spokes of `v` are plain, as in the interior of an oriented surface. Then the
/// next corners are exactly the neighbours. Also returns false for more than 16 triangles, because
/// it compares all pairs.
bool has_plain_spokes(Index v, std::span<const Index> around, std::span<const Triangle> triangles);

}  // namespace lapwing
