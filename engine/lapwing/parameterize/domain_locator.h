#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/closest_point.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Finds the triangle of a planar triangulation that contains a point. Uses a uniform grid with one
/// cell per triangle on average. A point outside is replaced by the nearest boundary point.
/// Thread-safe.
class DomainLocator {
 public:
  /// Copies `triangles` and `points`. O(n).
  DomainLocator(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points);
  ~DomainLocator();
  DomainLocator(DomainLocator&&) noexcept;
  DomainLocator& operator=(DomainLocator&&) noexcept;

  /// Returns the triangle at `point` with barycentric coordinates. At a vertex, its coordinate is 1
  /// up to rounding errors.
  SurfacePoint locate(const Eigen::Vector2d& point) const;
  /// Locates all points in parallel.
  std::vector<SurfacePoint> locate(std::span<const Eigen::Vector2d> points) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace lapwing
