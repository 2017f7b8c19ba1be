#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The distortion of a planar triangulation relative to its surface. With G >= g the largest and
/// least factor by which a triangle's lengths grow from the plane to the surface, its stretch is
/// sqrt((G^2 + g^2) / 2) (Sander et al. 2001), and its shear is G / g. Stretch is relative to that
/// of a map of the same areas that keeps all proportions. Both are 1 if shape is kept.
struct MapDistortion {
  double stretch = 1.0;          ///< root mean square over the surface
  double largest_stretch = 1.0;  ///< of any triangle
  double shear = 1.0;            ///< mean over the surface
  double largest_shear = 1.0;
};

/// Ignores triangles without area in the plane or on the surface.
MapDistortion measure_distortion(std::span<const Triangle> triangles,
                                 std::span<const Eigen::Vector3d> positions,
                                 std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
