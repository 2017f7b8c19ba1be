#include "tools/screen_geometry.h"

#include <algorithm>
#include <limits>

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;

template <class Contains>
VertexSet vertices_where(std::span<const Vector2d> pixels, Contains contains) {
  VertexSet vertices;
  for (Index v = 0; v < pixels.size(); ++v) {
    if (contains(pixels[v])) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace

double distance_to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

bool is_in_polygon(const Vector2d& p, std::span<const Vector2d> polygon) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& a = polygon[i];
    const Vector2d& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y())) inside = !inside;
  }
  return inside;
}

std::vector<Vector2d> vertex_pixels(std::span<const Eigen::Vector3d> positions,
                                    const Projection& projection) {
  const Vector2d nowhere = Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<Vector2d> pixels;
  pixels.reserve(positions.size());
  for (const auto& p : positions) pixels.push_back(projection.to_pixel(p).value_or(nowhere));
  return pixels;
}

VertexSet near_line(std::span<const Vector2d> pixels, const Vector2d& from, const Vector2d& to,
                    double radius) {
  return vertices_where(
      pixels, [&](const Vector2d& p) { return distance_to_segment(p, from, to) <= radius; });
}

VertexSet in_rectangle(std::span<const Vector2d> pixels, const Vector2d& corner,
                       const Vector2d& opposite) {
  const Eigen::Array2d low = corner.cwiseMin(opposite);
  const Eigen::Array2d high = corner.cwiseMax(opposite);
  return vertices_where(pixels, [&](const Vector2d& p) {
    return (p.array() >= low).all() && (p.array() <= high).all();
  });
}

VertexSet in_polygon(std::span<const Vector2d> pixels, std::span<const Vector2d> polygon) {
  return vertices_where(pixels, [&](const Vector2d& p) { return is_in_polygon(p, polygon); });
}

}  // namespace lapwing::viewer
