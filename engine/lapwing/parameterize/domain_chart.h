#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Lays a domain conformally over the unit disk, its boundary on the circle: a disk by scaling, a
/// square by the lemniscate sine, which is the inverse of its Schwarz-Christoffel map. (A rectangle
/// along the axes is scaled to a square first.) Keeps the symmetries of the domain, to rounding.
class DomainChart {
 public:
  /// Throws InputError when the boundary vertices lie neither on a circle nor on a rectangle
  /// along the axes.
  DomainChart(std::span<const Index> boundary, std::span<const Eigen::Vector2d> points);

  struct Place {
    Eigen::Vector2d z;     ///< in the closed unit disk
    double clearance = 0;  ///< 1 - |z|^2, without cancellation at the sides of a square
  };
  Place place(const Eigen::Vector2d& point) const;

 private:
  bool is_rectangle_ = false;
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_size_ = Eigen::Vector2d::Ones();
};

}  // namespace lapwing
