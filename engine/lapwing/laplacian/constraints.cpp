#include "lapwing/laplacian/constraints.h"

namespace lapwing {

Constraints constraints_of(const EditRegion& region, const Topology& topology, double weight,
                           bool hard) {
  std::vector<char> anchored(topology.vertex_count(), 0);
  for (const Index v : region.belt) anchored[v] = 1;
  for (const auto& handle : region.handles) {
    for (const Index v : handle) anchored[v] = 1;
  }
  std::vector<char> is_given(topology.vertex_count(), 0);
  std::vector<char> is_drawn(topology.vertex_count(), 0);
  for (const Target& target : region.targets) {
    if (region.hard_targets && target.is_vertex()) is_given[target.corners[0]] = 1;
    is_drawn[target.corners[0]] = 1;
  }
  Constraints constraints;
  std::vector<Index> vertices;
  for (const Index v : region.roi) {
    const bool held = anchored[v] != 0;
    if (is_given[v] != 0) continue;
    if (held ? hard : (topology.rings[v].empty() && is_drawn[v] == 0)) continue;
    vertices.push_back(v);
    constraints.W.push_back(held ? weight * weight : 0.0);
  }
  constraints.unknowns = Unknowns(std::move(vertices), topology.vertex_count());
  return constraints;
}

}  // namespace lapwing
