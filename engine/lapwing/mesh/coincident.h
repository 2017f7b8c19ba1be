#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// For each position the number of the first one exactly equal to it (its own number if there is no
/// earlier one). 0 equals -0; a position that is not finite equals no other. Expected linear time.
std::vector<Index> first_at_same_position(std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
