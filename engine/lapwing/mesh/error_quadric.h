#pragma once

#include <Eigen/Core>

namespace lapwing {

/// The quadric error sum_t area_t (distance to the plane of t)^2 = x'A x + 2 g.x + c. x is the
/// offset from a vertex, which keeps the numbers small far from the origin.
struct ErrorQuadric {
  Eigen::Vector3d diagonal = Eigen::Vector3d::Zero();  ///< diagonal of the symmetric matrix A
  Eigen::Vector3d beside = Eigen::Vector3d::Zero();    ///< entries yz, xz and xy of A
  Eigen::Vector3d g = Eigen::Vector3d::Zero();
  double c = 0.0;

  /// Adds a plane through the vertex.
  void add_plane(const Eigen::Vector3d& normal, double area) {
    const Eigen::Vector3d n = area * normal;
    diagonal += n.cwiseProduct(normal);
    beside += Eigen::Vector3d(n.y() * normal.z(), n.x() * normal.z(), n.x() * normal.y());
  }
  /// Returns A x.
  Eigen::Vector3d times(const Eigen::Vector3d& x) const {
    return {diagonal.x() * x.x() + beside.z() * x.y() + beside.y() * x.z(),
            beside.z() * x.x() + diagonal.y() * x.y() + beside.x() * x.z(),
            beside.y() * x.x() + beside.x() * x.y() + diagonal.z() * x.z()};
  }
  /// Returns the error at `offset` from the vertex.
  double at(const Eigen::Vector3d& offset) const { return offset.dot(times(offset) + 2.0 * g) + c; }
  /// Adds `other`, whose vertex lies at -offset from this one's.
  void add(const ErrorQuadric& other, const Eigen::Vector3d& offset) {
    diagonal += other.diagonal;
    beside += other.beside;
    g += other.g + other.times(offset);
    c += other.at(offset);
  }
};

}  // namespace lapwing
