#include "lapwing/wrap/surfels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kNeighbours = 6;
constexpr double kRadius = 0.8;   // inscribed circle, relative to the farthest neighbour's distance
constexpr double kLargest = 3.0;  // relative to the median; keeps the surfels of outliers small
constexpr std::size_t kSpacingsPerTask = 512;

// Returns the distance from each point to its sixth-nearest neighbour.
std::vector<double> spacings_of(std::span<const Vector3d> points) {
  std::vector<Triangle> single(points.size());
  for (Index k = 0; k < points.size(); ++k) single[k] = {k, k, k};
  const ClosestPoint closest(single, points);
  const double first = bounds_of(points).diagonal() / std::sqrt(static_cast<double>(points.size()));
  std::vector<double> spacings(points.size(), 0.0);
  parallel_for(points.size(), kSpacingsPerTask, [&](std::size_t begin, std::size_t end) {
    double radius = first;
    for (std::size_t k = begin; k < end; ++k) {
      std::vector<double> distances;
      const auto search = [&] {
        distances.clear();
        for (const TrianglePoint& found : closest.within(0, points[k], radius)) {
          distances.push_back((found.position - points[k]).norm());
        }
      };
      for (search(); distances.size() <= kNeighbours; search()) radius *= 1.5;
      std::ranges::nth_element(distances, distances.begin() + kNeighbours);
      spacings[k] = distances[kNeighbours];
      // The next point is probably close, and needs a circle of about the same size.
      if (spacings[k] > 0.0) radius = 1.2 * spacings[k];
    }
  });
  return spacings;
}

}  // namespace

Mesh surfels_of(const Mesh& cloud, const std::string& where) {
  const std::size_t count = cloud.vertex_count();
  const std::vector<Vector3d>& normals = cloud.attributes().normals;
  if (count <= kNeighbours) {
    throw InputError(where + ": it has " + std::to_string(count) +
                     " vertices and no faces; a point cloud needs at least " +
                     std::to_string(kNeighbours + 1) + " points");
  }
  if (normals.size() != count) {
    throw InputError(where + ": it has " + std::to_string(count) +
                     " points, no faces and no normals. Compute normals that point outward, or "
                     "triangulate it");
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (!cloud.positions[k].allFinite() || !(normals[k].norm() > 0.0)) {
      throw InputError(where + ": point " + std::to_string(k) +
                       " is not finite or has no normal. Remove it");
    }
  }
  const std::vector<double> spacings = spacings_of(cloud.positions);
  std::vector<double> sorted = spacings;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::ranges::nth_element(sorted, middle);
  const double largest = kLargest * *middle;
  Mesh surfels;
  surfels.positions = cloud.positions;
  CancelCheck cancel_check;
  for (Index k = 0; k < count; ++k) {
    cancel_check();
    const Vector3d normal = normals[k].normalized();
    const Vector3d u = normal.unitOrthogonal();
    const Vector3d v = normal.cross(u);
    const double corner = 2.0 * kRadius * std::min(spacings[k], largest);
    const auto first = static_cast<Index>(surfels.positions.size());
    for (int c = 0; c < 3; ++c) {
      const double angle = 2.0 * std::numbers::pi / 3.0 * c;
      surfels.positions.push_back(cloud.positions[k] +
                                  corner * (std::cos(angle) * u + std::sin(angle) * v));
    }
    surfels.add_face(std::array{k, first, first + 1});
    surfels.add_face(std::array{k, first + 1, first + 2});
    surfels.add_face(std::array{k, first + 2, first});
  }
  return surfels;
}

SurfacePoint point_of_surfel(const SurfacePoint& place) {
  return place.is_nowhere() ? place : SurfacePoint::at_vertex(std::ranges::min(place.corners));
}

}  // namespace lapwing
