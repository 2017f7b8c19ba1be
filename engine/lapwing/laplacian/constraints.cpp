#include "lapwing/laplacian/constraints.h"

#include <algorithm>

namespace lapwing {

namespace {

// Returns the fraction of the full stiffness for a graded weight from 0 to 1. It is the fourth
// power of the weight because a stiffness W overcomes the bending stiffness of the surface at
// wavelengths above W^(-1/4) edges. A weight of 1/2 thus constrains wavelengths above 2 edges, and
// a weight of 1/10 those above 10 edges. On a sheet with a falloff 24 edges wide, the surface
// follows the handle by the factors 1, 0.84 and 0.25 at half, three quarters and the full width of
// the falloff.
double graded_share(double weight) {
  const double square = weight * weight;
  return square * square;
}

}  // namespace

Constraints constraints_of(const EditRegion& region, const Topology& topology,
                           std::optional<double> weight, bool hard) {
  std::vector<std::optional<double>> handle_weights = region.handle_weights;
  handle_weights.resize(region.handles.size());
  const auto squared = [&](std::optional<double> factor) {
    const double product = weight.value_or(1.0) * factor.value_or(1.0);
    return product * product;
  };
  const auto stiffness = [&](std::optional<double> factor) {
    return weight || factor ? squared(factor) : kStiff;
  };
  std::vector<double> anchored(topology.vertex_count(), 0.0);
  for (const Index v : region.belt) anchored[v] = stiffness({});
  for (std::size_t h = 0; h < region.handles.size(); ++h) {
    for (const Index v : region.handles[h]) anchored[v] = stiffness(handle_weights[h]);
  }
  std::vector<char> is_given(topology.vertex_count(), 0);
  std::vector<char> is_drawn(topology.vertex_count(), 0);
  for (const Target& target : region.targets) {
    if (region.hard_targets) {
      if (target.is_vertex()) is_given[target.corners[0]] = 1;
      // Constraints of belt and handles would keep the target from its position.
      for (const Index corner : target.corners) anchored[corner] = 0.0;
    }
    is_drawn[target.corners[0]] = 1;
  }
  std::vector<double> graded(topology.vertex_count(), 0.0);
  for (const FalloffVertex& g : region.graded) {
    graded[g.vertex] = squared(handle_weights[g.handle]) * graded_share(g.weight);
  }
  Constraints constraints;
  std::vector<Index> vertices;
  for (const Index v : region.roi) {
    const bool held = anchored[v] > 0.0;
    if (is_given[v] != 0) continue;
    const bool drawn = is_drawn[v] != 0 || graded[v] > 0.0;
    if (held ? hard : (topology.rings[v].empty() && !drawn)) continue;
    vertices.push_back(v);
    constraints.W.push_back(held ? anchored[v] : graded[v]);
  }
  constraints.unknowns = Unknowns(std::move(vertices), topology.vertex_count());
  return constraints;
}

std::vector<Eigen::Vector3d> dirichlet_values(std::span<const Index> roi, const Unknowns& unknowns,
                                              std::span<const Eigen::Vector3d> prescribed) {
  const auto is_given = [&](Index v) {
    return unknowns.of_vertex[v] == kNoIndex && !prescribed[v].isZero(0.0);
  };
  std::vector<Eigen::Vector3d> given;
  if (std::none_of(roi.begin(), roi.end(), is_given)) return given;
  given.assign(prescribed.size(), Eigen::Vector3d::Zero());
  for (const Index v : roi) {
    if (is_given(v)) given[v] = prescribed[v];
  }
  return given;
}

}  // namespace lapwing
