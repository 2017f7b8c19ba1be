#pragma once

#include "lapwing/session/bound_step.h"

namespace lapwing {

/// Where to start settling so that the surface keeps the winding of its handles: every vertex makes
/// a share of each handle's motion between `from` and `to`, all of it on that handle, nothing on
/// belt and other handles, and between them as its geodesic distances from these are. `positions`
/// are those after share `from` of the step. One fast march for each handle and for what stays.
///
/// Settling alone cannot find the winding: turns of 260 degrees and of -100 put the handle in the
/// same place, both can be minima, and from the linear solution, which knows the handle's rotation
/// but not its whole turns, it comes to the second.
Positions turned_start(const BoundStep& bound, std::span<const Eigen::Vector3d> positions,
                       double from, double to);

}  // namespace lapwing
