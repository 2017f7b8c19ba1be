#pragma once

#include <optional>
#include <string>

#include "lapwing/deform/modifiers/resolved_request.h"

namespace lapwing {

/// The handle of a request with the largest turn.
struct LargestTurn {
  std::size_t handle = 0;
  AxisRotation turn;  ///< degrees 0 or more
};
LargestTurn largest_turn(const DeformRequest& request);

/// Returns the accumulated rotation of the rings about the axis of `largest`, from `start`, the
/// surface before the request, to `end`. It is summed along a shortest edge path from a vertex that
/// stays to that handle, whole turns included. If the surface came out as written, it is the
/// handle's turn; otherwise it differs by whole turns. Returns nothing if no path leads from what
/// stays, and for turns up to 90 degrees, which have only one direction.
std::optional<double> winding_degrees(const ResolvedRequest& bound, const LargestTurn& largest,
                                      std::span<const Eigen::Vector3d> start,
                                      std::span<const Eigen::Vector3d> end);

/// Returns a warning that names the handle, what happened and what to change, if `request` neither
/// settles nor commits and turns a handle by more than kLargestSettledTurnDegrees, or if `wound`
/// differs from the turn by more than 180 degrees. Otherwise empty.
std::string winding_warning(const DeformRequest& request, const std::optional<double>& wound);

}  // namespace lapwing
