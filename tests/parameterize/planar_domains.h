#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A triangulated planar domain, as `warp_domain` takes it.
struct PlanarDomain {
  std::vector<Triangle> triangles;
  std::vector<Index> boundary;
  std::vector<Eigen::Vector2d> points;
};

/// The unit disk in `rings` rings of six equal sectors, the centre vertex 0. Ring k has radius
/// `radius(k / rings)`.
inline PlanarDomain disk_of_rings(
    Index rings, const std::function<double(double)>& radius = [](double share) { return share; }) {
  PlanarDomain disk;
  disk.points.emplace_back(0.0, 0.0);
  for (Index r = 1; r <= rings; ++r) {
    for (Index a = 0; a < 6 * r; ++a) {
      const double angle = 2.0 * std::numbers::pi * a / (6.0 * r);
      disk.points.push_back(radius(static_cast<double>(r) / rings) *
                            Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
  const auto vertex = [](Index r, Index a) {
    return r == 0 ? 0 : 3 * r * (r - 1) + 1 + a % (6 * r);
  };
  for (Index r = 1; r <= rings; ++r) {
    for (Index sector = 0; sector < 6; ++sector) {
      for (Index k = 0; k < r; ++k) {
        const Index outer = sector * r + k;
        const Index inner = sector * (r - 1) + k;
        disk.triangles.push_back({vertex(r, outer), vertex(r, outer + 1), vertex(r - 1, inner)});
        if (k + 1 == r) continue;
        disk.triangles.push_back(
            {vertex(r - 1, inner), vertex(r, outer + 1), vertex(r - 1, inner + 1)});
      }
    }
  }
  for (Index a = 0; a < 6 * rings; ++a) disk.boundary.push_back(vertex(rings, a));
  return disk;
}

/// The unit square as `grid(size, size)`.
inline PlanarDomain square_grid(Index size) {
  const Mesh mesh = grid(size, size);
  PlanarDomain square;
  square.triangles = mesh.topology().triangles;
  for (const Eigen::Vector3d& p : mesh.positions) square.points.emplace_back(p.x(), p.y());
  const Index row = size + 1;
  for (Index k = 0; k < size; ++k) square.boundary.push_back(k);
  for (Index k = 0; k < size; ++k) square.boundary.push_back(k * row + size);
  for (Index k = size; k > 0; --k) square.boundary.push_back(size * row + k);
  for (Index k = size; k > 0; --k) square.boundary.push_back(k * row);
  return square;
}

inline Index nearest_vertex(const PlanarDomain& domain, const Eigen::Vector2d& point) {
  Index nearest = 0;
  for (Index v = 0; v < domain.points.size(); ++v) {
    if ((domain.points[v] - point).norm() < (domain.points[nearest] - point).norm()) nearest = v;
  }
  return nearest;
}

}  // namespace lapwing
