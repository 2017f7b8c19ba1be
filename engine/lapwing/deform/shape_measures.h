#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// How one pose of a mesh differs from its rest pose. `rows` are the vertices measured, each with
/// its whole ring; `weights` those of the Laplacians, as laplacian_weights gives them; R_i the best
/// rotation of ring i from rest to current; `stretch` the S_i that are asked for, one per vertex of
/// the mesh, or empty for the identity. All in linear time.

/// How far details are from their rest shapes, turned with their rings:
/// sqrt(sum |L(v'_i) - R_i S_i delta_i|^2 / sum |S_i delta_i|^2) over `rows`. 0 for a rigid motion,
/// 1 for details that are lost; 0 where there are none.
double detail_error(std::span<const Index> rows, const Topology& topology,
                    std::span<const double> weights, std::span<const Eigen::Vector3d> rest,
                    std::span<const Eigen::Vector3d> current,
                    std::span<const Eigen::Matrix3d> stretch = {});

/// The same where the R_i are known, by vertex of the mesh.
double detail_error(std::span<const Index> rows, const Topology& topology,
                    std::span<const double> weights, std::span<const Eigen::Vector3d> rest,
                    std::span<const Eigen::Vector3d> current,
                    std::span<const Eigen::Matrix3d> rotations,
                    std::span<const Eigen::Matrix3d> stretch);

/// Root mean square over the ring edges of `rows` of |length' / length - 1|, where length is the
/// mean of |S_i e| over both ends i of the edge e. Edges without length do not count.
double edge_stretch(std::span<const Index> rows, const Topology& topology,
                    std::span<const Eigen::Vector3d> rest, std::span<const Eigen::Vector3d> current,
                    std::span<const Eigen::Matrix3d> stretch = {});

/// The edge whose length changes most, relative to itself, the first of equal ones, and its
/// |length' / length - 1|. No vertices where every edge keeps its length.
struct StretchedEdge {
  std::array<Index, 2> vertices{kNoIndex, kNoIndex};  ///< the lower first
  double stretch = 0.0;
};

/// Over the ring edges of `rows`, on all processors.
struct EdgeStretches {
  double root_mean_square = 0.0;  ///< `edge_stretch`
  StretchedEdge most;
};
EdgeStretches edge_stretches(std::span<const Index> rows, const Topology& topology,
                             std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> current,
                             std::span<const Eigen::Matrix3d> stretch = {});

/// What became of each vertex's ring; all lists as long as `vertices`.
struct VertexMeasures {
  std::vector<Index> vertices;
  std::vector<double> rotation_degrees;  ///< the angle of R_i, 0 to 180
  /// |L(v'_i) - R_i delta_i| relative to the root mean square of |delta| over all of `vertices`: a
  /// vertex without detail of its own is measured against what is usual around it. The root mean
  /// square of this list is `detail_error`. All 0 where nothing has detail.
  std::vector<double> detail_error;
  std::vector<double> stretch;  ///< `edge_stretch` of the ring alone; 0 without a ring
  std::vector<Eigen::Vector3d> displacement;
  std::vector<Eigen::Quaterniond> rotation;  ///< R_i as `unit_quaternion` has it: w >= 0
};

/// Measures each of `rows`, on all processors.
VertexMeasures measure_vertices(std::span<const Index> rows, const Topology& topology,
                                std::span<const double> weights,
                                std::span<const Eigen::Vector3d> rest,
                                std::span<const Eigen::Vector3d> current);

/// Angle of a rotation in radians, 0 to pi; accurate at both ends, where arccos alone is not.
double rotation_angle(const Eigen::Matrix3d& R);

}  // namespace lapwing
