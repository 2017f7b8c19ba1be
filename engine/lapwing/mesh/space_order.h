#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The numbers of the points along a curve that fills the space around them (Morton 1966): most
/// neighbours on a surface are close in it. Coordinates that are not numbers count as the least.
/// O(n log n).
std::vector<Index> order_in_space(std::span<const Eigen::Vector3f> points);

}  // namespace lapwing
