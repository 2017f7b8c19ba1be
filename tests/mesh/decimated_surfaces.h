#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "lapwing/mesh/shapes.h"

namespace lapwing::test {

/// A sphere of 2,562 vertices with bumps, of whose merges no two cost the same.
inline Mesh bumpy_sphere() {
  Mesh mesh = icosphere(4);
  for (Eigen::Vector3d& p : mesh.positions) {
    p *= 1.0 + 0.1 * std::sin(7.0 * p.x() + 1.0) * std::cos(5.0 * p.y() + 2.0 * p.z());
  }
  return mesh;
}

/// Vertices - edges + triangles.
inline long characteristic(const std::vector<Triangle>& triangles) {
  std::set<Index> vertices;
  std::set<std::pair<Index, Index>> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      vertices.insert(t[c]);
      edges.insert(std::minmax(t[c], t[(c + 1) % 3]));
    }
  }
  return static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
         static_cast<long>(triangles.size());
}

}  // namespace lapwing::test
