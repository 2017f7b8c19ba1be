#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Tells which corners of triangles share a normal. Two corners at a vertex share a normal if
/// smooth edges at the vertex connect their triangles. The first normal of vertex v has index v.
/// The extra normals have the indices after that of the last vertex.
struct SplitNormals {
  std::vector<Index> of_corner;  ///< the normal of each corner, 3 t + k for corner k of triangle t
  std::vector<Index> extra_vertices;  ///< the vertex of each extra normal, ascending
};

/// At the default angle, the edges of a cube are hard, and a prism with nine sides looks round.
inline constexpr double kFeatureAngleDegrees = 40.0;

/// Splits the normals at hard edges. An edge is hard if the normals of its polygons differ by more
/// than `feature_angle_degrees`. Boundary edges, non-manifold edges and edges between polygons of
/// inconsistent orientation are also hard. An angle of 180 degrees splits no normals. Polygons with
/// zero area use the first normals of their vertices. The cost is O(n log k) for n triangles, with
/// k around each vertex.
SplitNormals split_normals(std::span<const Eigen::Vector3d> positions, const Topology& topology,
                           double feature_angle_degrees);

}  // namespace lapwing
