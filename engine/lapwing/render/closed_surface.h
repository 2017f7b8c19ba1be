#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns whether the backs of triangles show only to an eye inside: every edge joins two
/// triangles that traverse it in opposite directions, and every connected piece encloses a positive
/// volume. A self-intersecting piece may still show a back. O(n log n).
bool is_closed_outward(std::span<const Eigen::Vector3d> positions,
                       std::span<const Triangle> triangles);

}  // namespace lapwing
