#pragma once

#include <span>
#include <vector>

#include "lapwing/region/vertex_set.h"
#include "tools/projection.h"

namespace lapwing::viewer {

/// Where the vertices show, found once for a stroke. NaN behind the eye.
std::vector<Eigen::Vector2d> vertex_pixels(std::span<const Eigen::Vector3d> positions,
                                           const Projection& projection);

/// The vertices that show within `radius` of the way from `from` to `to`.
VertexSet near_line(std::span<const Eigen::Vector2d> pixels, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& to, double radius);

/// The vertices that show in the rectangle between two corners.
VertexSet in_rectangle(std::span<const Eigen::Vector2d> pixels, const Eigen::Vector2d& corner,
                       const Eigen::Vector2d& opposite);

/// The vertices that show inside a polygon, which is closed by itself; where it crosses itself,
/// what it goes around an odd number of times.
VertexSet in_polygon(std::span<const Eigen::Vector2d> pixels,
                     std::span<const Eigen::Vector2d> polygon);

}  // namespace lapwing::viewer
