#pragma once

#include <optional>
#include <string>

#include "lapwing/deform/modifiers/bound_request.h"

namespace lapwing {

/// The handle of a request that turns most, and by what.
struct LargestTurn {
  std::size_t handle = 0;
  AxisRotation turn;  ///< degrees 0 or more
};
LargestTurn largest_turn(const DeformRequest& request);

/// How far the surface `end` is wound about the axis of `largest`, from what stays to that handle,
/// beside `start`, the surface before the request: the turn of rings about that axis followed from
/// one ring to the next, whole turns included. Where the surface came out as written this is the
/// handle's turn, otherwise it is whole turns away. Nothing without a path from what stays, or for
/// turns up to 90 degrees, which nothing winds another way.
std::optional<double> wound_degrees(const BoundRequest& bound, const LargestTurn& largest,
                                    std::span<const Eigen::Vector3d> start,
                                    std::span<const Eigen::Vector3d> end);

/// What to tell about `request` where it turns a handle by more than kLargestSettledTurnDegrees and
/// commits nothing on the way, or where it came out `wound` otherwise than written: which handle,
/// what happened, what to change. Empty when all is well.
std::string winding_warning(const DeformRequest& request, const std::optional<double>& wound);

}  // namespace lapwing
