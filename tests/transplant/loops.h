#pragma once

#include <map>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"

namespace lapwing::test {

/// The positions along the one boundary loop of `mesh`, the surface on the left.
inline std::vector<Eigen::Vector3d> loop_points(const Mesh& mesh) {
  std::map<std::pair<Index, Index>, int> sides;
  for (const Triangle& t : build_topology(mesh).triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  }
  std::map<Index, Index> next;
  for (const auto& [side, count] : sides) {
    if (!sides.contains({side.second, side.first})) next[side.first] = side.second;
  }
  std::vector<Eigen::Vector3d> points;
  for (Index v = next.begin()->first; points.size() < next.size(); v = next.at(v)) {
    points.push_back(mesh.positions[v]);
  }
  return points;
}

inline std::vector<Eigen::Vector3d> moved(const Eigen::Affine3d& motion,
                                          std::vector<Eigen::Vector3d> points) {
  for (Eigen::Vector3d& p : points) p = motion * p;
  return points;
}

/// A similarity far from the identity.
inline Eigen::Affine3d similarity(double degrees, const Eigen::Vector3d& axis, double scale,
                                  const Eigen::Vector3d& translation) {
  return Eigen::Translation3d(translation) *
         Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized()) * Eigen::Scaling(scale);
}

}  // namespace lapwing::test
