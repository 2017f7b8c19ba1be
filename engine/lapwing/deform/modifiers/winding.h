#pragma once

#include <optional>
#include <string>

#include "lapwing/deform/modifiers/substeps.h"

namespace lapwing {

/// Returns the accumulated rotation of the rings about the axis of `largest`, from `start`, the
/// surface before the request, to `end`: the handle's turn, or a value that differs by whole turns.
/// It is summed along a shortest edge path from a vertex that stays to that handle. Returns nothing
/// without such a path, and for turns up to 90 degrees, which have only one direction.
std::optional<double> winding_degrees(const ResolvedRequest& bound, const LargestTurn& largest,
                                      std::span<const Eigen::Vector3d> start,
                                      std::span<const Eigen::Vector3d> end);

/// Returns a warning that names the handle, what happened and what to change, if `wound` differs
/// from the turn by more than 180 degrees. Otherwise empty.
std::string winding_warning(const DeformRequest& request, const std::optional<double>& wound);

}  // namespace lapwing
