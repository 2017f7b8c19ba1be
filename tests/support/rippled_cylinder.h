#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::test {

/// The cylinder on which the behaviour under large rotations is measured: radius 0.5, height 6,
/// `around` x `rings` vertices, odd rings turned half a step, radius rippled by 3%.
inline Mesh rippled_cylinder(Index around = 60, Index rings = 121) {
  using std::numbers::pi;
  Mesh mesh;
  for (Index k = 0; k < rings; ++k) {
    const double z = 6.0 * k / (rings - 1);
    for (Index i = 0; i < around; ++i) {
      const double a = 2.0 * pi * (i + 0.5 * (k % 2)) / around;
      const double r = 0.5 * (1.0 + 0.03 * std::sin(8.0 * a) * std::sin(20.0 * pi * z / 6.0));
      mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), z);
    }
  }
  const auto triangle = [&](Index a, Index b, Index c) { mesh.add_face(std::array{a, b, c}); };
  for (Index k = 0; k + 1 < rings; ++k) {
    for (Index i = 0; i < around; ++i) {
      const Index a = k * around + i;
      const Index b = k * around + (i + 1) % around;
      const Index c = a + around;
      const Index d = b + around;
      if (k % 2 == 0) {
        triangle(a, b, c);
        triangle(b, d, c);
      } else {
        triangle(a, b, d);
        triangle(a, d, c);
      }
    }
  }
  return mesh;
}

/// Belt: z < 0.6; handle: z > 5.4.
inline EditRegion ends_of_cylinder(const Mesh& mesh) {
  EditRegion region;
  region.handles.resize(1);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    region.roi.push_back(v);
    if (mesh.positions[v].z() < 0.6) region.belt.push_back(v);
    if (mesh.positions[v].z() > 5.4) region.handles[0].push_back(v);
  }
  return region;
}

/// Turns by `degrees` about an axis through the middle of the handle, then moves.
inline Eigen::Affine3d turn_and_move(double degrees, const Eigen::Vector3d& axis,
                                     const Eigen::Vector3d& move) {
  const Eigen::Vector3d pivot(0.0, 0.0, 5.7);
  return Eigen::Translation3d(pivot + move) *
         Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis) * Eigen::Translation3d(-pivot);
}

}  // namespace lapwing::test
