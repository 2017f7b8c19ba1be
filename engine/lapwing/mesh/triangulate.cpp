#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Twice the signed area of the triangle a, b, c.
double orient(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// The polygon in its mean plane, counter-clockwise: Newell's normal is the axis that the polygon
// turns around, whatever its shape.
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
  if (!(normal.norm() > 0.0)) return plane;
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

bool is_ear(const std::vector<Vector2d>& plane, const std::vector<std::size_t>& left,
            std::size_t at) {
  const std::size_t m = left.size();
  const std::size_t a = left[(at + m - 1) % m];
  const std::size_t b = left[at];
  const std::size_t c = left[(at + 1) % m];
  if (!(orient(plane[a], plane[b], plane[c]) > 0.0)) return false;
  return std::none_of(left.begin(), left.end(), [&](std::size_t p) {
    // A corner at the same point, as where a bridge to a hole comes back, does not block the ear.
    if (plane[p] == plane[a] || plane[p] == plane[b] || plane[p] == plane[c]) return false;
    return orient(plane[a], plane[b], plane[p]) >= 0.0 &&
           orient(plane[b], plane[c], plane[p]) >= 0.0 &&
           orient(plane[c], plane[a], plane[p]) >= 0.0;
  });
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
  const std::vector<Vector2d> plane = project_to_mean_plane(polygon, positions);
  std::vector<std::size_t> left(n);
  for (std::size_t i = 0; i < n; ++i) left[i] = i;
  // Clip ears from the second corner on, so that a convex polygon becomes the fan of its first.
  const bool clip = !fan_is_valid(plane);
  while (left.size() > 3) {
    std::size_t ear = 1;
    if (clip) {
      const std::size_t m = left.size();
      for (std::size_t tried = 0; tried < m; ++tried) {
        const std::size_t at = (1 + tried) % m;
        if (is_ear(plane, left, at)) {
          ear = at;
          break;
        }
      }
    }
    const std::size_t m = left.size();
    triangles.push_back(
        {polygon[left[(ear + m - 1) % m]], polygon[left[ear]], polygon[left[(ear + 1) % m]]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({polygon[left[0]], polygon[left[1]], polygon[left[2]]});
}

}  // namespace lapwing
