#include "lapwing/region/submesh.h"

#include <algorithm>

namespace lapwing {
namespace {

// The triangles with a corner in the region, ascending.
std::vector<Index> triangles_at(const VertexSet& region, const Topology& topology) {
  std::vector<Index> triangles;
  for (const Index v : region) {
    const auto around = topology.vertex_triangles[v];
    triangles.insert(triangles.end(), around.begin(), around.end());
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace

Submesh submesh_around(const VertexSet& region, const Topology& topology) {
  Submesh part;
  std::vector<Index> own_number(topology.vertex_count(), kNoIndex);
  const auto take = [&](Index v) {
    if (own_number[v] != kNoIndex) return;
    own_number[v] = 0;
    part.vertices.push_back(v);
  };
  for (const Index v : region) {
    take(v);
    for (const Index j : topology.rings[v]) take(j);
  }
  std::sort(part.vertices.begin(), part.vertices.end());
  for (Index own = 0; own < part.vertices.size(); ++own) own_number[part.vertices[own]] = own;
  for (const Index v : region) part.region.push_back(own_number[v]);

  for (const Index t : triangles_at(region, topology)) {
    const auto& [a, b, c] = topology.triangles[t];
    part.topology.triangles.push_back({own_number[a], own_number[b], own_number[c]});
    part.topology.triangle_faces.push_back(topology.triangle_faces[t]);
  }
  part.topology.vertex_triangles =
      triangles_around_vertices(part.vertices.size(), part.topology.triangles);
  part.topology.rings = rings_by_triangles(part.topology.vertex_triangles, part.topology.triangles);
  return part;
}

VertexSet own_numbers(const Submesh& submesh, const VertexSet& members) {
  VertexSet own;
  own.reserve(members.size());
  Index at = 0;
  for (const Index v : members) {
    while (submesh.vertices[at] != v) ++at;
    own.push_back(at);
  }
  return own;
}

}  // namespace lapwing
