#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// How a planar triangulation distorts the surface it belongs to. With G >= g the largest and least
/// factor by which a triangle's lengths grow from the plane to the surface, its stretch is
/// sqrt((G^2 + g^2) / 2) (Sander et al. 2001), taken here relative to that of a map of the same
/// areas that keeps all proportions, and its shear G / g. Both are 1 where shape is kept.
struct MapDistortion {
  double stretch = 1.0;          ///< root mean square over the surface
  double largest_stretch = 1.0;  ///< of any triangle
  double shear = 1.0;            ///< mean over the surface
  double largest_shear = 1.0;
};

/// Triangles without area in the plane or on the surface are left out.
MapDistortion measure_distortion(std::span<const Triangle> triangles,
                                 std::span<const Eigen::Vector3d> positions,
                                 std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
