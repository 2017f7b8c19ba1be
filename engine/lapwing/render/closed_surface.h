#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns whether back faces are visible only from inside: every edge joins two triangles that
/// traverse it in opposite directions, and every connected component encloses a positive volume. A
/// back face of a self-intersecting component may still be visible. O(n log n).
bool is_closed_outward(std::span<const Eigen::Vector3d> positions,
                       std::span<const Triangle> triangles);

}  // namespace lapwing
