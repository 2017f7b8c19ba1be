#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Whether triangles show their backs only to an eye inside: every edge joins two of them that run
/// along it in opposite directions, and every connected piece encloses a positive volume. A piece
/// that passes through itself may still turn a back outwards. O(n log n).
bool is_closed_outward(std::span<const Eigen::Vector3d> positions,
                       std::span<const Triangle> triangles);

}  // namespace lapwing
