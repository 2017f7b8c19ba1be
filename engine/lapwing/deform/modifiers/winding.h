#pragma once

#include <optional>
#include <string>

#include "lapwing/deform/modifiers/substeps.h"

namespace lapwing {

/// Returns the accumulated rotation of the rings about the axis of `largest`, in degrees. `start`
/// is the surface before the request and `end` the surface after it. The rotation is accumulated
/// along a shortest edge path from a vertex that does not move to the handle. It equals the
/// handle's turn up to a multiple of 360 degrees. Returns nothing if no path exists. Also returns
/// nothing if the turn is at most 90 degrees, because its direction is unambiguous.
std::optional<double> winding_degrees(const ResolvedRequest& bound, const LargestTurn& largest,
                                      std::span<const Eigen::Vector3d> start,
                                      std::span<const Eigen::Vector3d> end);

/// Returns a warning that suggests a remedy if `wound` differs from the handle's turn by more than
/// 180 degrees. Otherwise returns an empty string.
std::string winding_warning(const DeformRequest& request, const std::optional<double>& wound);

}  // namespace lapwing
