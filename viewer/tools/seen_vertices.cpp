#include "tools/seen_vertices.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace lapwing::viewer {
namespace {

using Eigen::Vector3d;

// The surface slopes, so a triangle that shows at a pixel may be nearer to the eye than a visible
// vertex beside it, by this many pixels.
constexpr double kPixelsOfDepth = 3.0;

}  // namespace

bool SeenVertices::operator()(Index vertex) const {
  const Vector3d& point = positions_[vertex];
  const auto pixel = projection_.to_pixel(point);
  if (!pixel) return false;
  const double x = std::floor(pixel->x());
  const double y = std::floor(pixel->y());
  if (!(x >= 0.0 && y >= 0.0 && x < picture_.width && y < picture_.height)) return false;
  const Ray sight = projection_.ray_through(*pixel);
  const double tolerance = kPixelsOfDepth * projection_.length_of_pixel(point);
  const auto column = static_cast<Index>(x);
  const auto row = static_cast<Index>(y);
  for (Index r = std::max(row, 1U) - 1; r <= std::min(row + 1, picture_.height - 1); ++r) {
    for (Index c = std::max(column, 1U) - 1; c <= std::min(column + 1, picture_.width - 1); ++c) {
      const std::uint32_t id = picture_.ids[std::size_t{r} * picture_.width + c];
      // Background beside the outline of the surface does not make a vertex visible.
      const bool at_vertex = r == row && c == column;
      if (id == 0 ? at_vertex : !hides(id - 1, vertex, sight, tolerance)) return true;
    }
  }
  return false;
}

// Whether all corners of the triangle are nearer to the eye than the vertex by more than
// `tolerance`.
bool SeenVertices::hides(Index triangle, Index vertex, const Ray& sight, double tolerance) const {
  const double depth = (positions_[vertex] - sight.origin).dot(sight.direction);
  const Triangle& corners = topology_.triangles[triangle];
  return std::all_of(corners.begin(), corners.end(), [&](Index v) {
    return (positions_[v] - sight.origin).dot(sight.direction) < depth - tolerance;
  });
}

}  // namespace lapwing::viewer
