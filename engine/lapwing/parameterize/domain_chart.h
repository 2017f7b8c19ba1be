#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Lays a domain smoothly over the unit disk, its boundary on the circle: a disk by scaling, a
/// rectangle along the axes by (x, y) -> (x sqrt(1 - y^2/2), y sqrt(1 - x^2/2)) on [-1, 1]^2, which
/// keeps the symmetries of the square.
class DomainChart {
 public:
  /// Throws InputError when the boundary vertices lie neither on a circle nor on a rectangle.
  DomainChart(std::span<const Index> boundary, std::span<const Eigen::Vector2d> points);

  struct Place {
    Eigen::Vector2d z;     ///< in the closed unit disk
    double clearance = 0;  ///< 1 - |z|^2, without cancellation at the sides of a rectangle
  };
  Place place(const Eigen::Vector2d& point) const;

 private:
  bool is_rectangle_ = false;
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_size_ = Eigen::Vector2d::Ones();
};

}  // namespace lapwing
