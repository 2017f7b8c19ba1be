#pragma once

#include <optional>
#include <string>

#include "lapwing/deform/modifiers/substeps.h"

namespace lapwing {

/// Returns the accumulated rotation of the rings about the axis of `largest`, from the surface
/// `start` before the request to `end`. The result is the handle's turn, or differs from it by
/// whole turns. It is the sum along a shortest edge path from a vertex that does not move to the
/// handle. Returns nothing if no path exists, and for turns up to 90 degrees, which have only one
/// direction.
std::optional<double> winding_degrees(const ResolvedRequest& bound, const LargestTurn& largest,
                                      std::span<const Eigen::Vector3d> start,
                                      std::span<const Eigen::Vector3d> end);

/// Returns a warning with advice if `wound` differs from the handle's turn by more than 180
/// degrees. Otherwise returns an empty string.
std::string winding_warning(const DeformRequest& request, const std::optional<double>& wound);

}  // namespace lapwing
