#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"

namespace lapwing::test {

/// By how many degrees the triangles of `mesh` turn over its edges, ascending: 0 where it is flat.
/// `counts`, when not empty, marks the vertices between which an edge counts.
inline std::vector<double> dihedral_angles(const Mesh& mesh, std::span<const char> counts = {}) {
  std::map<std::pair<Index, Index>, Eigen::Vector3d> normals;
  std::vector<double> angles;
  for (const Triangle& t : mesh.topology().triangles) {
    const Eigen::Vector3d a = mesh.positions[t[1]] - mesh.positions[t[0]];
    const Eigen::Vector3d b = mesh.positions[t[2]] - mesh.positions[t[0]];
    const Eigen::Vector3d normal = a.cross(b).stableNormalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const Index low = std::min(t[k], t[(k + 1) % 3]);
      const Index high = std::max(t[k], t[(k + 1) % 3]);
      const auto [at, is_new] = normals.try_emplace({low, high}, normal);
      if (is_new || (!counts.empty() && (counts[low] == 0 || counts[high] == 0))) continue;
      angles.push_back(std::acos(std::clamp(at->second.dot(normal), -1.0, 1.0)) * 180.0 /
                       std::numbers::pi);
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// Of ascending values, what `share` of them do not exceed.
inline double percentile(const std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(place)];
}

}  // namespace lapwing::test
