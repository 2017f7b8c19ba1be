#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/ear_clipper.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Projects the polygon to its mean plane, counter-clockwise. Newell's normal is the axis that a
// polygon of any shape turns around.
std::vector<Vector2d> project_to_mean_plane(std::span<const Index> polygon,
                                            std::span<const Vector3d> positions) {
  const std::size_t n = polygon.size();
  const Vector3d origin = positions[polygon[0]];
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d a = positions[polygon[i]] - origin;
    const Vector3d b = positions[polygon[(i + 1) % n]] - origin;
    normal += a.cross(b);
  }
  std::vector<Vector2d> plane(n, Vector2d::Zero());
  if (!(normal.norm() > 0.0) || !std::isfinite(normal.norm())) return plane;
  normal.normalize();
  Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.cross(u);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d p = positions[polygon[i]] - origin;
    plane[i] = {p.dot(u), p.dot(v)};
  }
  return plane;
}

bool fan_is_valid(const std::vector<Vector2d>& plane) {
  for (std::size_t i = 1; i + 1 < plane.size(); ++i) {
    if (!(orient(plane[0], plane[i], plane[i + 1]) > 0.0)) return false;
  }
  return true;
}

}  // namespace

void triangulate_polygon(std::span<const Index> polygon, std::span<const Vector3d> positions,
                         std::vector<Triangle>& triangles) {
  const std::size_t n = polygon.size();
  if (n < 3) return;
  if (n == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
  };
  const std::vector<Vector2d> plane = project_to_mean_plane(polygon, positions);
  // Ear clipping would cut a convex polygon in the same way.
  if (fan_is_valid(plane)) {
    for (std::size_t i = 1; i + 1 < n; ++i) add(0, i, i + 1);
  } else {
    EarClipper(plane).clip(add);
  }
}

}  // namespace lapwing
