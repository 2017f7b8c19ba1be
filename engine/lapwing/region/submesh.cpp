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

std::vector<VertexSet> region_components(const VertexSet& region, const Topology& topology) {
  // The mark of a vertex is cleared when the vertex is added to a component.
  std::vector<char> unvisited = vertex_mask(topology.vertex_count(), region);
  std::vector<VertexSet> components;
  CancelCheck cancel_check;
  for (const Index seed : region) {
    cancel_check();
    if (!unvisited[seed] || topology.rings.size(seed) == 0) continue;
    VertexSet component{seed};
    unvisited[seed] = 0;
    for (std::size_t next = 0; next < component.size(); ++next) {
      for (const Index w : topology.rings[component[next]]) {
        if (!unvisited[w]) continue;
        unvisited[w] = 0;
        component.push_back(w);
      }
    }
    std::sort(component.begin(), component.end());
    components.push_back(std::move(component));
  }
  return components;
}

RegionTriangles region_triangles(const VertexSet& region, const Topology& topology) {
  RegionTriangles part;
  std::vector<char> within = vertex_mask(topology.vertex_count(), region);
  std::vector<Triangle> whole;
  CancelCheck cancel_check;
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    cancel_check();
    const auto& [a, b, c] = topology.triangles[t];
    if (within[a] == 0 || within[b] == 0 || within[c] == 0) continue;
    part.sources.push_back(static_cast<Index>(t));
    whole.push_back(topology.triangles[t]);
  }
  NumberedTriangles own = numbered(whole);
  part.vertices = std::move(own.vertices);
  part.triangles = std::move(own.triangles);
  part.loose = subtract(region, part.vertices);
  return part;
}

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
