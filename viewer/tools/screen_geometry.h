#pragma once

#include <span>
#include <vector>

#include "lapwing/region/vertex_set.h"
#include "tools/projection.h"

namespace lapwing::viewer {

/// Returns the distance from `p` to the segment from `a` to `b`; NaN if `p` is.
double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                           const Eigen::Vector2d& b);

/// Whether `p` is inside the polygon by the even-odd rule. The last point joins to the first.
bool is_in_polygon(const Eigen::Vector2d& p, std::span<const Eigen::Vector2d> polygon);

/// Returns the pixels of the vertices, to be computed once per stroke. NaN behind the eye.
std::vector<Eigen::Vector2d> vertex_pixels(std::span<const Eigen::Vector3d> positions,
                                           const Projection& projection);

/// Returns the vertices that show within `radius` pixels of the segment from `from` to `to`.
VertexSet near_line(std::span<const Eigen::Vector2d> pixels, const Eigen::Vector2d& from,
                    const Eigen::Vector2d& to, double radius);

/// Returns the vertices that show in the rectangle between two corners.
VertexSet in_rectangle(std::span<const Eigen::Vector2d> pixels, const Eigen::Vector2d& corner,
                       const Eigen::Vector2d& opposite);

/// Returns the vertices that show inside a polygon by the even-odd rule. The last point joins to
/// the first.
VertexSet in_polygon(std::span<const Eigen::Vector2d> pixels,
                     std::span<const Eigen::Vector2d> polygon);

}  // namespace lapwing::viewer
