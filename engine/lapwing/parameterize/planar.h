#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Returns twice the signed area, positive for a counterclockwise triangle.
inline double doubled_area(const Triangle& t, std::span<const Eigen::Vector2d> points) {
  return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

/// Returns whether every triangle is counterclockwise.
bool is_bijective(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points);

/// Returns the largest step along `moves`, at most 1, for which every triangle keeps at least the
/// fraction `share` of its area: the smallest positive root of a quadratic per triangle (Smith and
/// Schaefer 2015, §3.3, for share 0).
double largest_step(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points,
                    std::span<const Eigen::Vector2d> moves, double share);

/// Returns points + step * moves. If a move is zero, the result is bitwise equal to the point.
std::vector<Eigen::Vector2d> moved(std::span<const Eigen::Vector2d> points,
                                   std::span<const Eigen::Vector2d> moves, double step);

/// Returns the square root of the triangles' total area. This size is invariant under rotations of
/// the domain.
double extent(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points);

/// Returns whether `point` is strictly inside the polygon with these corners.
bool is_inside(const Eigen::Vector2d& point, std::span<const Index> polygon,
               std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
