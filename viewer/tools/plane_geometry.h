#pragma once

#include <span>

#include <Eigen/Core>

namespace lapwing::viewer {

/// From `p` to the nearest point between `a` and `b`. NaN where `p` is.
double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b);

/// Whether the polygon, which is closed by itself, goes around `p` an odd number of times.
bool is_in_polygon(const Eigen::Vector2d& p, std::span<const Eigen::Vector2d> polygon);

}  // namespace lapwing::viewer
