#include "lapwing/laplacian/constraints.h"

namespace lapwing {

double stiffness_of(double weight) {
  const double square = weight * weight;
  return square * square;
}

Constraints constraints_of(const EditRegion& region, const Topology& topology, double weight,
                           bool hard) {
  std::vector<double> handle_weights = region.handle_weights;
  handle_weights.resize(region.handles.size(), 1.0);
  // In units of the constraint weight; 0 if the vertex is not held.
  std::vector<double> anchored(topology.vertex_count(), 0.0);
  for (const Index v : region.belt) anchored[v] = 1.0;
  for (std::size_t h = 0; h < region.handles.size(); ++h) {
    for (const Index v : region.handles[h]) anchored[v] = handle_weights[h];
  }
  std::vector<char> is_given(topology.vertex_count(), 0);
  std::vector<char> is_drawn(topology.vertex_count(), 0);
  for (const Target& target : region.targets) {
    if (region.hard_targets && target.is_vertex()) is_given[target.corners[0]] = 1;
    is_drawn[target.corners[0]] = 1;
  }
  std::vector<double> graded(topology.vertex_count(), 0.0);
  for (const FalloffVertex& g : region.graded) {
    const double full = handle_weights[g.handle];
    graded[g.vertex] = full * full * stiffness_of(g.weight);
  }
  Constraints constraints;
  std::vector<Index> vertices;
  for (const Index v : region.roi) {
    const bool held = anchored[v] > 0.0;
    if (is_given[v] != 0) continue;
    const bool drawn = is_drawn[v] != 0 || graded[v] > 0.0;
    if (held ? hard : (topology.rings[v].empty() && !drawn)) continue;
    vertices.push_back(v);
    constraints.W.push_back(weight * weight * (held ? anchored[v] * anchored[v] : graded[v]));
  }
  constraints.unknowns = Unknowns(std::move(vertices), topology.vertex_count());
  return constraints;
}

}  // namespace lapwing
