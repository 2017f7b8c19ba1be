#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The corner of a triangle that comes after that at `v`, and the one that comes before it.
inline Index next_corner(const Triangle& triangle, Index v) {
  if (triangle[0] == v) return triangle[1];
  return triangle[1] == v ? triangle[2] : triangle[0];
}
inline Index last_corner(const Triangle& triangle, Index v) {
  if (triangle[0] == v) return triangle[2];
  return triangle[1] == v ? triangle[0] : triangle[1];
}

/// An edge at a vertex, and in how many triangles there its other end comes next after the vertex,
/// and last before it.
struct Spoke {
  Index to = kNoIndex;
  std::size_t as_next = 0;
  std::size_t as_last = 0;

  std::size_t triangles() const { return as_next + as_last; }
  bool is_plain() const { return as_next == 1 && as_last == 1; }
};

/// Those of a vertex, by other ends, ascending. `around`: the triangles there.
std::vector<Spoke> spokes_of(Index v, std::span<const Index> around,
                             std::span<const Triangle> triangles);

/// Whether all of them are plain, as inside a surface with one orientation: the corners that come
/// next are the neighbours then. False for more than 16 triangles, too, since each is compared with
/// each.
bool has_plain_spokes(Index v, std::span<const Index> around, std::span<const Triangle> triangles);

}  // namespace lapwing
