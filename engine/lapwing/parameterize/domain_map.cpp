#include "lapwing/parameterize/domain_map.h"

#include <limits>

#include "lapwing/parameterize/boundary.h"
#include "lapwing/parameterize/mean_value.h"

namespace lapwing {

using Eigen::Vector2d;

DomainMap mean_value_map(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                         Domain domain, const BoundaryPins& pins) {
  const std::vector<Vector2d> boundary = boundary_points(patch, own_positions, domain, pins);
  return {domain, mean_value_points(patch, own_positions, boundary)};
}

std::vector<Index> flipped_triangles(std::span<const Triangle> triangles,
                                     std::span<const Vector2d> points) {
  // Rounding of a difference of two products of differences.
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  std::vector<Index> flipped;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Vector2d u = points[b] - points[a];
    const Vector2d v = points[c] - points[a];
    const double doubled_area = u.x() * v.y() - u.y() * v.x();
    if (!(doubled_area > kRounding * u.norm() * v.norm())) flipped.push_back(static_cast<Index>(t));
  }
  return flipped;
}

}  // namespace lapwing
