#include "lapwing/region/region_triangles.h"

#include "lapwing/base/cancellation.h"

namespace lapwing {

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

}  // namespace lapwing
