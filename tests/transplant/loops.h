#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/transplant/loop_curve.h"

namespace lapwing::test {

/// The positions along the first boundary loop of `mesh`, the surface on the left.
inline std::vector<Eigen::Vector3d> first_loop(const Mesh& mesh) {
  const auto loops = boundary_loops(mesh.topology().triangles, "mesh");
  return loop_points(loops.at(0), mesh.positions);
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
         Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized()) *
         Eigen::Scaling(scale);
}

/// Of radius 1 around the z axis, counter-clockwise.
inline std::vector<Eigen::Vector3d> circle_points(std::size_t count, double phase = 0.0) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t k = 0; k < count; ++k) {
    const double a =
        2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count) + phase;
    points.emplace_back(std::cos(a), std::sin(a), 0.0);
  }
  return points;
}

/// The largest of an entry.
inline double difference(const Eigen::Affine3d& a, const Eigen::Affine3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

/// The mesh without the faces with a corner less than `radius` from a point.
inline Mesh with_hole(const Mesh& mesh, const Eigen::Vector3d& center, double radius) {
  Mesh result;
  result.positions = mesh.positions;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::all_of(face.begin(), face.end(),
                    [&](Index v) { return (mesh.positions[v] - center).norm() >= radius; })) {
      result.add_face(face);
    }
  }
  return result;
}

}  // namespace lapwing::test
