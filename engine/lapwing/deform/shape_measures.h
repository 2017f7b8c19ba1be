#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Measures of a pose against the rest pose, in linear time. `rows` are the measured vertices, each
/// with its whole ring. `weights` are the Laplacian weights (laplacian_weights). R_i is the best
/// rotation of ring i from rest to current. `stretch` contains the prescribed S_i, one per vertex
/// of the mesh; if it is empty, all S_i are the identity.

/// Returns the relative difference between the details and their rest shapes, which rotate with
/// their rings:
///     sqrt(sum |L(v'_i) - R_i S_i delta_i|^2 / sum |S_i delta_i|^2) over `rows`.
/// It is 0 for a rigid motion, and 1 if all details are lost. It is NaN for a flat surface, because
/// its delta_i are only rounding errors.
double detail_error(std::span<const Index> rows, const Topology& topology,
                    std::span<const double> weights, std::span<const Eigen::Vector3d> rest,
                    std::span<const Eigen::Vector3d> current,
                    std::span<const Eigen::Matrix3d> stretch = {});

/// Like `detail_error` above, for known R_i, one per vertex of the mesh.
double detail_error(std::span<const Index> rows, const Topology& topology,
                    std::span<const double> weights, std::span<const Eigen::Vector3d> rest,
                    std::span<const Eigen::Vector3d> current,
                    std::span<const Eigen::Matrix3d> rotations,
                    std::span<const Eigen::Matrix3d> stretch);

/// Returns the root mean square of |length' / length - 1| over the ring edges of `rows`. `length`
/// is the mean of |S_i e| over both ends i of edge e. Edges of length 0 do not count.
double edge_stretch(std::span<const Index> rows, const Topology& topology,
                    std::span<const Eigen::Vector3d> rest, std::span<const Eigen::Vector3d> current,
                    std::span<const Eigen::Matrix3d> stretch = {});

/// The edge with the largest |length' / length - 1|, or the first of several. The vertices are
/// kNoIndex if no edge changes its length.
struct StretchedEdge {
  std::array<Index, 2> vertices{kNoIndex, kNoIndex};  ///< the lower number first
  double stretch = 0.0;
};

/// Stretch of the ring edges of `rows`, computed on all CPU cores.
struct EdgeStretches {
  double root_mean_square = 0.0;  ///< `edge_stretch`
  StretchedEdge most;
};
EdgeStretches edge_stretches(std::span<const Index> rows, const Topology& topology,
                             std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> current,
                             std::span<const Eigen::Matrix3d> stretch = {});

/// Measures of each vertex's ring. All lists have the length of `vertices`.
struct VertexMeasures {
  std::vector<Index> vertices;
  std::vector<double> rotation_degrees;  ///< the angle of R_i, 0 to 180
  /// |L(v'_i) - R_i delta_i| divided by the root mean square of |delta| over `vertices`. The root
  /// mean square of this list is therefore `detail_error`. All values are NaN for a flat surface.
  std::vector<double> detail_error;
  std::vector<double> stretch;  ///< `edge_stretch` of only this ring; 0 without a ring
  std::vector<Eigen::Vector3d> displacement;
  std::vector<Eigen::Quaterniond> rotation;  ///< R_i as a `unit_quaternion`: w >= 0
};

/// Measures each of `rows`, using all CPU cores.
VertexMeasures measure_vertices(std::span<const Index> rows, const Topology& topology,
                                std::span<const double> weights,
                                std::span<const Eigen::Vector3d> rest,
                                std::span<const Eigen::Vector3d> current);

/// Returns the angle of a rotation in radians, 0 to pi. Accurate near 0 and pi, unlike arccos.
double rotation_angle(const Eigen::Matrix3d& R);

}  // namespace lapwing
