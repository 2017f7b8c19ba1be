#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The motion of each vertex from one pose of a mesh to another, one entry per vertex in each list.
struct VertexMotion {
  Positions displacements;
  /// Rotation of the vertex's ring (`fit_rotation`), as a `unit_quaternion`. Exactly the identity
  /// if neither the vertex nor its ring moved.
  std::vector<Eigen::Quaterniond> rotations;
  /// `edge_stretch` of the ring: the root mean square of |length' / length - 1| of its edges; 0
  /// without a ring.
  std::vector<double> stretch;
};

/// Returns the motion of every vertex from `rest` to `current`. Takes linear time and uses all CPU
/// cores. For a result of `deform`, call vertex_motion(before.positions, deformed.mesh.positions,
/// before.topology()).
VertexMotion vertex_motion(std::span<const Eigen::Vector3d> rest,
                           std::span<const Eigen::Vector3d> current, const Topology& topology);

/// Like `vertex_motion` above, but only for the vertices `rows`. All other vertices have exactly no
/// motion, even if their ring contains one of `rows`.
VertexMotion vertex_motion(std::span<const Index> rows, std::span<const Eigen::Vector3d> rest,
                           std::span<const Eigen::Vector3d> current, const Topology& topology);

/// Returns the quaternion of R with w >= 0. If w = 0 (half a turn), the first non-zero component is
/// positive. `rotation_angle` equals 2 acos(w), in radians.
Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& R);

/// Returns `fit_rotation` of ring i, or exactly the identity if no vertex of the ring moved.
Eigen::Matrix3d ring_rotation(Index i, std::span<const Index> ring,
                              std::span<const Eigen::Vector3d> rest,
                              std::span<const Eigen::Vector3d> current);

}  // namespace lapwing
