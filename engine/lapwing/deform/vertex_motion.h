#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// How each vertex moved from one pose of a mesh to another; one entry per vertex in each list.
struct VertexMotion {
  Positions displacements;
  /// How the ring of the vertex turned (`fit_rotation`, as the certificate measures it), about the
  /// origin's axes: of length 1 and with w >= 0, see `unit_quaternion`. Exactly the identity where
  /// neither the vertex nor its ring moved.
  std::vector<Eigen::Quaterniond> rotations;
  /// `edge_stretch` of the ring: the root mean square of |length' / length - 1| of its edges; 0
  /// without a ring.
  std::vector<double> stretch;
};

/// The motion of every vertex from `rest` to `current`. Linear time, on all processors. Of what
/// `deform` did: vertex_motion(before.positions, deformed.mesh.positions, before.topology()).
VertexMotion vertex_motion(std::span<const Eigen::Vector3d> rest,
                           std::span<const Eigen::Vector3d> current, const Topology& topology);

/// The same where only `rows` are known to have moved: all others are at rest, to the last bit,
/// also where their ring holds one of `rows`.
VertexMotion vertex_motion(std::span<const Index> rows, std::span<const Eigen::Vector3d> rest,
                           std::span<const Eigen::Vector3d> current, const Topology& topology);

/// Returns the quaternion of R with w >= 0. If w = 0, half a turn, its first non-zero component is
/// positive. `rotation_angle` is 2 acos(w), in radians.
Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& R);

/// `fit_rotation` of ring i, and exactly the identity where nothing of it moved.
Eigen::Matrix3d ring_rotation(Index i, std::span<const Index> ring,
                              std::span<const Eigen::Vector3d> rest,
                              std::span<const Eigen::Vector3d> current);

}  // namespace lapwing
