#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The part of a surface that is inside out.
struct Inversion {
  double share = 0.0;  ///< fraction of the area that has an opposite side, 0 to 1
  /// A vertex near the middle of the inverted part; kNoIndex if `share` is 0.
  Index vertex = kNoIndex;
};

/// At rest, a ray from a vertex into the solid meets the opposite side of the surface. If that
/// point is on the outer side of the vertex's tangent plane after the deformation, the vertex
/// counts as inside out. Flipped triangles do not suffice for this test: a limb that is inside out
/// has only a few, at its two ends. Measures up to 4,096 vertices of `roi` and the triangles that
/// touch `roi`. Takes O(n log n).
Inversion measure_inversion(std::span<const Index> roi, const Topology& topology,
                            std::span<const Eigen::Vector3d> rest,
                            std::span<const Eigen::Vector3d> current);

}  // namespace lapwing
