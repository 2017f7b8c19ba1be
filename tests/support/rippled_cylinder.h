#pragma once

#include <numbers>

#include <Eigen/Geometry>

#include "lapwing/mesh/shapes.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::test {

using lapwing::rippled_cylinder;

/// Belt: z < `low`; handle: z > `high`.
inline EditRegion ends_of_cylinder(const Mesh& mesh, double low = 0.6, double high = 5.4) {
  EditRegion region;
  region.handles.resize(1);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    region.roi.push_back(v);
    if (mesh.positions[v].z() < low) region.belt.push_back(v);
    if (mesh.positions[v].z() > high) region.handles[0].push_back(v);
  }
  return region;
}

/// Returns a rotation by `degrees` about an axis through the centre of the handle, followed by a
/// translation.
inline Eigen::Affine3d turn_and_move(double degrees, const Eigen::Vector3d& axis,
                                     const Eigen::Vector3d& move) {
  const Eigen::Vector3d pivot(0.0, 0.0, 5.7);
  return Eigen::Translation3d(pivot + move) *
         Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis) * Eigen::Translation3d(-pivot);
}

}  // namespace lapwing::test
