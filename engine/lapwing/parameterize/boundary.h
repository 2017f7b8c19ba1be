#pragma once

#include <span>
#include <vector>

#include "lapwing/parameterize/domain_map.h"

namespace lapwing {

/// Returns the places of `patch.loop` in the domain, in its order, at which `mean_value_map` holds
/// it. A boundary edge counts as at least kShortestBoundaryEdge mean edge lengths long, so that no
/// two vertices coincide. Throws what `mean_value_map` throws about pins.
std::vector<Eigen::Vector2d> boundary_points(const Patch& patch,
                                             std::span<const Eigen::Vector3d> own_positions,
                                             Domain domain, const BoundaryPins& pins);

/// Small enough to leave ordinary boundaries alone, large enough to stay clear of rounding.
inline constexpr double kShortestBoundaryEdge = 1e-4;

}  // namespace lapwing
