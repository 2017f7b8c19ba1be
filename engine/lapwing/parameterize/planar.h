#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the signed area; positive for a counterclockwise triangle.
inline double doubled_area(const Triangle& t, std::span<const Eigen::Vector2d> points) {
  return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

/// Whether every triangle is counterclockwise.
bool is_bijective(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points);

/// How far along `moves`, at most 1, the points can go until some triangle has only `share` of its
/// area left: the first root of a quadratic per triangle (Smith and Schaefer 2015, §3.3, where the
/// share is 0).
double largest_step(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points,
                    std::span<const Eigen::Vector2d> moves, double share);

/// points + step * moves; a point whose move is zero keeps its bits.
std::vector<Eigen::Vector2d> moved(std::span<const Eigen::Vector2d> points,
                                   std::span<const Eigen::Vector2d> moves, double step);

/// The side of a square of the triangles' area: a length that turning the domain does not change.
double extent(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points);

/// Whether `point` lies inside the polygon with these corners and not on its sides.
bool is_inside(const Eigen::Vector2d& point, std::span<const Index> polygon,
               std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
