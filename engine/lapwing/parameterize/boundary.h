#pragma once

#include <span>
#include <vector>

#include "lapwing/parameterize/domain_map.h"

namespace lapwing {

/// Where the vertices of `patch.loop` lie in the domain, in the order of the loop: what
/// `mean_value_map` holds. A boundary edge counts as at least kShortestBoundaryEdge mean ones long,
/// so that no two vertices come to one point. Throws what `mean_value_map` throws of pins.
std::vector<Eigen::Vector2d> boundary_points(const Patch& patch,
                                             std::span<const Eigen::Vector3d> own_positions,
                                             Domain domain, const BoundaryPins& pins);

/// Small enough to leave ordinary boundaries alone, large enough to stay clear of rounding.
inline constexpr double kShortestBoundaryEdge = 1e-4;

}  // namespace lapwing
