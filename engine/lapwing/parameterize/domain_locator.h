#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/surface_point.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Finds the triangle of a planar triangulation over a point: a uniform grid with one cell per
/// triangle on average. A point outside gets the nearest point of the boundary. Threads may share
/// one.
class DomainLocator {
 public:
  /// Both are copied. O(n).
  DomainLocator(std::span<const Triangle> triangles, std::span<const Eigen::Vector2d> points);
  ~DomainLocator();
  DomainLocator(DomainLocator&&) noexcept;
  DomainLocator& operator=(DomainLocator&&) noexcept;

  /// A vertex of the triangulation gives that vertex with weight 1 up to rounding.
  SurfacePoint locate(const Eigen::Vector2d& point) const;
  /// All of them, on all threads.
  std::vector<SurfacePoint> locate(std::span<const Eigen::Vector2d> points) const;

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace lapwing
