#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Finds the triangle of a planar triangulation at a point, with a uniform grid of one cell per
/// triangle on average. Points outside get the nearest point of the boundary. Threads may share an
/// object.
class DomainLocator {
 public:
  /// Copies both. O(n).
  DomainLocator(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points);
  ~DomainLocator();
  DomainLocator(DomainLocator&&) noexcept;
  DomainLocator& operator=(DomainLocator&&) noexcept;

  /// Returns a vertex of the triangulation with weight 1, up to rounding, at its point.
  SurfacePoint locate(const Eigen::Vector2d& point) const;
  /// Locates all points, on all threads.
  std::vector<SurfacePoint> locate(std::span<const Eigen::Vector2d> points) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace lapwing
