#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// How much of a surface has been turned inside out.
struct Inversion {
  double share = 0.0;       ///< of the region's area that has an opposite side, 0 to 1
  Index vertex = kNoIndex;  ///< one near its middle; kNoIndex if the share is 0
};

/// At rest a ray from a vertex into the solid meets the opposite side of the surface. If that point
/// lies on the outer side of the vertex's tangent plane after the deformation, the vertex counts as
/// inside out. Flipped triangles show a fold; a limb that is inside out has few of them, only at
/// its two ends. Measures up to 4,096 vertices of `roi` and the triangles that touch it.
/// O(n log n).
Inversion measure_inversion(std::span<const Index> roi, const Topology& topology,
                            std::span<const Eigen::Vector3d> rest,
                            std::span<const Eigen::Vector3d> current);

}  // namespace lapwing
