#include "lapwing/region/submesh.h"

#include <algorithm>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

// Returns the triangles with a corner in the region, ascending.
std::vector<Index> triangles_at(const VertexSet& region, const Topology& topology) {
  std::vector<Index> triangles;
  for (const Index v : region) {
    const auto around = topology.vertex_triangles[v];
    triangles.insert(triangles.end(), around.begin(), around.end());
  }
  check_cancelled();
  std::sort(triangles.begin(), triangles.end());
  check_cancelled();
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace

Submesh submesh_around(const VertexSet& region, const Topology& topology) {
  Submesh part;
  part.vertices = with_ring_neighbours(region, topology.rings);
  const std::vector<Index> own_number = inverse_index(part.vertices, topology.vertex_count());
  for (const Index v : region) part.region.push_back(own_number[v]);

  CancelCheck cancel_check;
  for (const Index t : triangles_at(region, topology)) {
    cancel_check();
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
