#include "lapwing/region/region_triangles.h"

namespace lapwing {

RegionTriangles region_triangles(const VertexSet& region, const Topology& topology) {
  RegionTriangles part;
  std::vector<char> within = vertex_mask(topology.vertex_count(), region);
  std::vector<char> used(topology.vertex_count(), 0);
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    const auto& [a, b, c] = topology.triangles[t];
    if (within[a] == 0 || within[b] == 0 || within[c] == 0) continue;
    part.sources.push_back(static_cast<Index>(t));
    used[a] = used[b] = used[c] = 1;
  }
  std::vector<Index> own_number(topology.vertex_count(), kNoIndex);
  for (const Index v : region) {
    if (used[v] == 0) {
      part.loose.push_back(v);
      continue;
    }
    own_number[v] = static_cast<Index>(part.vertices.size());
    part.vertices.push_back(v);
  }
  part.triangles.reserve(part.sources.size());
  for (const Index t : part.sources) {
    const auto& [a, b, c] = topology.triangles[t];
    part.triangles.push_back({own_number[a], own_number[b], own_number[c]});
  }
  return part;
}

}  // namespace lapwing
