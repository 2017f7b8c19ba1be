#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/warp.h"

namespace lapwing {

/// Throws InputError, naming pull and vertex, if a warp is impossible: if a triangle is turned over
/// or flat, if a pulled vertex is on the boundary, in no triangle or pulled twice, or if a target
/// is not inside the boundary.
void check_warp(std::span<const Triangle> triangles, std::span<const Index> boundary,
                std::span<const Eigen::Vector2d> points, std::span<const PointPull> pulls);

/// Returns the pulls, ascending, that no bijection can meet together: those whose targets coincide
/// (nearer than `tolerance`), and those that turn over or flatten a triangle whose corners are all
/// pulled or held.
std::vector<Index> contradicting_pulls(std::span<const Triangle> triangles,
                                       std::span<const char> is_held,
                                       std::span<const Eigen::Vector2d> points,
                                       std::span<const PointPull> pulls, double tolerance);

}  // namespace lapwing
