#pragma once

#include <span>

#include <Eigen/Core>

namespace lapwing::viewer {

/// Returns the distance from `p` to the segment from `a` to `b`; NaN if `p` is.
double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b);

/// Whether `p` is inside the polygon by the even-odd rule. The last point joins to the first.
bool is_in_polygon(const Eigen::Vector2d& p, std::span<const Eigen::Vector2d> polygon);

}  // namespace lapwing::viewer
