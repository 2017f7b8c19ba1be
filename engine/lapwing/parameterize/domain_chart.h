#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A conformal map of a domain to the unit disk: scaling for a disk, and the lemniscate sine, the
/// inverse of the Schwarz-Christoffel map, for a square. An axis-aligned rectangle is first scaled
/// to a square. The map has the symmetries of the domain up to rounding errors.
class DomainChart {
 public:
  /// Throws InputError if the boundary vertices are neither on a circle nor on an axis-aligned
  /// rectangle.
  DomainChart(std::span<const Index> boundary, std::span<const Eigen::Vector2d> points);

  struct Place {
    Eigen::Vector2d z;     ///< in the closed unit disk
    double clearance = 0;  ///< 1 - |z|^2, without cancellation near the boundary of a square
  };
  Place place(const Eigen::Vector2d& point) const;

 private:
  bool is_rectangle_ = false;
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d half_size_ = Eigen::Vector2d::Ones();
};

}  // namespace lapwing
