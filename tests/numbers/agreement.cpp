#include "numbers/agreement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lapwing/closest/closest_point.h"

namespace lapwing::test {

Outcome outcome_of(const Operation& operation, const Mesh& plain, const Placement& placement) {
  try {
    return {operation.run(plain, placement), ""};
  } catch (const Error& error) {
    return {{}, error.what()};
  }
}

namespace {

// Of vertices of the one mesh that faces use, from the surface of the other.
double distance_from(const Mesh& surface, const Mesh& mesh) {
  const Topology& topology = surface.topology();
  Adjacency all;
  all.starts = {0, static_cast<Index>(topology.triangles.size())};
  all.values.resize(topology.triangles.size());
  std::iota(all.values.begin(), all.values.end(), Index{0});
  const ClosestPoint closest(topology.triangles, surface.positions, all);
  double largest = 0.0;
  for (const Index v : mesh.face_vertices()) {
    const Eigen::Vector3d& p = mesh.positions[v];
    largest = std::max(largest, (closest.find(0, p).position - p).norm());
  }
  return largest;
}

bool same_positions(const Mesh& a, const Mesh& b, double tolerance) {
  for (std::size_t v = 0; v < a.vertex_count(); ++v) {
    // Of vertices that were not finite before, too.
    if (a.positions[v] == b.positions[v] || !b.positions[v].allFinite()) continue;
    if (!((a.positions[v] - b.positions[v]).norm() <= tolerance)) return false;
  }
  return true;
}

}  // namespace

bool agrees(const Mesh& result, const Mesh& expected, double diagonal) {
  if (result.vertex_count() == expected.vertex_count() &&
      result.face_vertices() == expected.face_vertices()) {
    return same_positions(result, expected, kAgreement * diagonal);
  }
  const auto count = static_cast<double>(expected.vertex_count());
  return std::abs(static_cast<double>(result.vertex_count()) - count) <= kSameCount * count &&
         distance_from(result, expected) <= kSameSurface * diagonal &&
         distance_from(expected, result) <= kSameSurface * diagonal;
}

}  // namespace lapwing::test
