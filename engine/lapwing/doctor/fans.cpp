#include "lapwing/doctor/fans.h"

#include "lapwing/base/union_find.h"

namespace lapwing {

Fans find_fans(const Mesh& mesh, const Edges& edges) {
  const std::vector<Index>& vertex_of = mesh.face_vertices();
  UnionFind sets(vertex_of.size());
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const Index first = edges.sides[e][0];
    for (const Index side : edges.sides[e].subspan(1)) {
      const bool same_direction = vertex_of[side] == vertex_of[first];
      const Index side_end = edges.next_corner[side];
      const Index first_end = edges.next_corner[first];
      sets.unite(first, same_direction ? side : side_end);
      sets.unite(first_end, same_direction ? side_end : side);
    }
  }
  Fans fans;
  fans.of_corner.assign(vertex_of.size(), kNoIndex);
  std::vector<Index> first_fan(mesh.vertex_count(), kNoIndex);
  std::vector<unsigned char> is_bow_tie(mesh.vertex_count(), 0);
  const auto add_corner = [&](Index c) {
    const Index fan = sets.find(c);
    Index& known = first_fan[vertex_of[c]];
    fans.of_corner[c] = fan;
    if (known == kNoIndex) known = fan;
    if (known != fan) is_bow_tie[vertex_of[c]] = 1;
  };
  for (Index c = 0; c < vertex_of.size(); ++c) {
    if (edges.edge_of_side[c] == kNoIndex) continue;
    add_corner(c);
    add_corner(edges.next_corner[c]);
  }
  for (std::size_t v = 0; v < is_bow_tie.size(); ++v) {
    if (is_bow_tie[v]) fans.bow_tie_vertices.push_back(static_cast<Index>(v));
  }
  return fans;
}

std::size_t count_boundary_loops(const Edges& edges, const Fans& fans) {
  UnionFind sets(fans.of_corner.size());
  std::vector<unsigned char> on_boundary(fans.of_corner.size(), 0);
  std::size_t loops = 0;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (!edges.is_boundary(e)) continue;
    const Index side = edges.sides[e][0];
    const Index begin = fans.of_corner[side];
    const Index end = fans.of_corner[edges.next_corner[side]];
    // Each new fan opens a loop of its own; each edge that joins two closes one of them.
    for (const Index fan : {begin, end}) {
      if (!on_boundary[fan]) ++loops;
      on_boundary[fan] = 1;
    }
    if (sets.unite(begin, end)) --loops;
  }
  return loops;
}

}  // namespace lapwing
