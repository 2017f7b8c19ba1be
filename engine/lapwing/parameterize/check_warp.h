#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/warp.h"

namespace lapwing {

/// Throws InputError, naming pull and vertex, when a warp cannot be asked for: a triangle that is
/// turned over or flat, a vertex that is on the boundary or in no triangle or pulled twice, a
/// target that is not inside the boundary.
void check_warp(std::span<const Triangle> triangles, std::span<const Index> boundary,
                std::span<const Eigen::Vector2d> points, std::span<const PointPull> pulls);

/// Pulls that no bijection can meet together, ascending: those whose targets coincide (nearer than
/// `tolerance`), and those whose targets turn over or flatten a triangle all of whose corners are
/// pulled or held.
std::vector<Index> contradicting_pulls(std::span<const Triangle> triangles,
                                       std::span<const char> is_held,
                                       std::span<const Eigen::Vector2d> points,
                                       std::span<const PointPull> pulls, double tolerance);

}  // namespace lapwing
