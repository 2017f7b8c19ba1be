#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns the indices of the points in Morton order (Morton 1966), in which most neighbours on a
/// surface are close. NaN coordinates count as the smallest. O(n log n).
std::vector<Index> morton_order(std::span<const Eigen::Vector3f> points);

}  // namespace lapwing
