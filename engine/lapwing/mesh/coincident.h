#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns, for each position, the index of the first position exactly equal to it, which may be
/// its own. 0 equals -0. A position that is not finite equals no other. Expected linear time.
std::vector<Index> first_at_same_position(std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
