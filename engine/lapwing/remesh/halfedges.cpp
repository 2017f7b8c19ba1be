#include "lapwing/remesh/halfedges.h"

#include <array>
#include <utility>

namespace lapwing::remeshing {

Halfedges::Halfedges(std::size_t vertex_count, std::span<const Triangle> triangles,
                     std::vector<Index> twins)
    : twins_(std::move(twins)),
      sides_(3 * triangles.size(), kNoIndex),
      outgoing_(vertex_count, kNoIndex) {
  origins_.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) origins_.insert(origins_.end(), t.begin(), t.end());
  for (Index h = 0; h < origins_.size(); ++h) {
    Index& out = outgoing_[origins_[h]];
    if (out == kNoIndex || twins_[h] == kNoIndex) out = h;
  }
}

int Halfedges::valence(Index v) const {
  int count = 0;
  for_neighbours(v, [&](Index) { ++count; });
  return count;
}

void Halfedges::glue(Index h, Index twin) {
  if (h != kNoIndex) twins_[h] = twin;
  if (twin != kNoIndex) twins_[twin] = h;
}

// Before, with h from v to u:           After:
//        a                                 a
//      /   \                             / | \             .
//     v --- u                           v -m- u
//      \   /                             \ | /
//        b                                 b
Index Halfedges::split(Index h) {
  const Index k = twins_[h];
  const Index u = target(h);
  const auto m = static_cast<Index>(outgoing_.size());
  const auto above = static_cast<Index>(origins_.size());  // m u a
  const Index below = above + 3;                           // u m b
  origins_.insert(origins_.end(), {m, u, apex(h), u, m, apex(k)});
  twins_.resize(twins_.size() + 6, kNoIndex);
  sides_.insert(sides_.end(), {sides_[h], sides_[next(h)], kNoIndex,  //
                               sides_[k], kNoIndex, sides_[previous(k)]});
  outgoing_.push_back(k);

  const Index to_a = next(h);
  const Index from_b = previous(k);
  const auto take_over = [&](Index old, Index now) {
    glue(now, twins_[old]);
    if (outgoing_[origins_[old]] == old) outgoing_[origins_[old]] = now;
    sides_[old] = kNoIndex;
  };
  take_over(to_a, above + 1);
  take_over(from_b, below + 2);
  if (outgoing_[u] == k) outgoing_[u] = below;
  origins_[to_a] = m;
  origins_[k] = m;
  glue(to_a, above + 2);
  glue(from_b, below + 1);
  glue(above, below);
  return m;
}

void Halfedges::flip(Index h) {
  const Index k = twins_[h];
  const Index v = origins_[h];
  const Index u = origins_[k];
  struct Edge {
    Index origin, twin, side, old;
  };
  const auto take = [&](Index e) { return Edge{origins_[e], twins_[e], sides_[e], e}; };
  // The edges of the quad v b u a, counterclockwise.
  const std::array outer{take(next(k)), take(previous(k)), take(next(h)), take(previous(h))};
  const std::array slots{previous(h), next(k), previous(k), next(h)};
  std::array<bool, 4> was_first{};
  for (std::size_t i = 0; i < 4; ++i) {
    was_first[i] = outgoing_[outer[i].origin] == outer[i].old;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Edge& e = outer[i];
    origins_[slots[i]] = e.origin;
    sides_[slots[i]] = e.side;
    glue(slots[i], e.twin);
    if (was_first[i]) outgoing_[e.origin] = slots[i];
  }
  if (outgoing_[v] == h) outgoing_[v] = slots[0];
  if (outgoing_[u] == k) outgoing_[u] = slots[2];
  origins_[h] = outer[1].origin;  // b
  origins_[k] = outer[3].origin;  // a
}

// Removes a triangle two of whose corners were merged. The half-edges to and from the third corner
// (the apex) now coincide with opposite directions, so their twins become each other's twins.
void Halfedges::merge_edges(Index to_apex, Index from_apex) {
  const Index a = twins_[from_apex];  // ends at the apex
  const Index b = twins_[to_apex];    // starts at the apex
  const Index apex = origins_[from_apex];
  const Index end = origins_[to_apex];
  const Index side_to = on_line(to_apex)     ? sides_[to_apex]
                        : on_line(from_apex) ? sides_[from_apex] ^ 1U
                                             : kNoIndex;
  glue(a, b);
  if (a != kNoIndex) {
    twins_[a] = b;
    sides_[a] = side_to;
  }
  if (b != kNoIndex) {
    twins_[b] = a;
    sides_[b] = side_to == kNoIndex ? kNoIndex : side_to ^ 1U;
  }
  if (outgoing_[apex] == from_apex) outgoing_[apex] = b != kNoIndex ? b : next(a);
  if (outgoing_[end] == to_apex) outgoing_[end] = a != kNoIndex ? a : next(b);
}

void Halfedges::collapse(Index h) {
  const Index k = twins_[h];
  const Index v = origins_[h];
  const Index u = target(h);
  const Index to_a = next(h);
  const Index from_a = previous(h);
  const Index to_b = next(k);
  const Index from_b = previous(k);
  const Index any_of_u = twins_[from_a];  // from v to a; becomes the half-edge from u to a
  for_outgoing(v, [&](Index out) { origins_[out] = u; });
  const bool u_loses_first = outgoing_[u] == k || outgoing_[u] == to_a;
  const bool a_on_border = twins_[to_a] == kNoIndex;
  merge_edges(to_a, from_a);
  merge_edges(to_b, from_b);
  if (u_loses_first && !a_on_border) outgoing_[u] = any_of_u;
  for (const Index dead : {h, to_a, from_a, k, to_b, from_b}) origins_[dead] = kNoIndex;
  outgoing_[v] = kNoIndex;
}

}  // namespace lapwing::remeshing
