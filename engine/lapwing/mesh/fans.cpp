#include "lapwing/mesh/fans.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"

namespace lapwing {

Fans find_fans(const Mesh& mesh, const Edges& edges) {
  const std::vector<Index>& vertex_of = mesh.face_vertices();
  UnionFind sets = linked_fans(
      edges.sides, vertex_of.size(), [&](Index c) { return vertex_of[c]; },
      [&](Index c) { return edges.next_corner[c]; });
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
  CancelCheck cancel_check;
  for (Index c = 0; c < vertex_of.size(); ++c) {
    cancel_check();
    if (edges.edge_of_side[c] == kNoIndex) continue;
    add_corner(c);
    add_corner(edges.next_corner[c]);
  }
  for (std::size_t v = 0; v < is_bow_tie.size(); ++v) {
    cancel_check();
    if (is_bow_tie[v]) fans.bow_tie_vertices.push_back(static_cast<Index>(v));
  }
  return fans;
}

std::size_t count_boundary_loops(const Edges& edges, const Fans& fans) {
  const auto fan_of = [&](Index c) { return fans.of_corner[c]; };
  UnionFind loops = linked_loops(edges.sides, fans.of_corner.size(), fan_of,
                                 [&](Index c) { return edges.next_corner[c]; });
  std::vector<char> found(fans.of_corner.size(), 0);
  for (std::size_t e = 0; e < edges.count(); ++e) {
    if (edges.is_boundary(e)) found[loops.find(fan_of(edges.sides[e][0]))] = 1;
  }
  return static_cast<std::size_t>(std::count(found.begin(), found.end(), 1));
}

}  // namespace lapwing
