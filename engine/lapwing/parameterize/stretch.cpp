#include "lapwing/parameterize/stretch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Measures {
  double surface_area = 0.0;
  double plane_area = 0.0;
  double squared_stretch = 0.0;
  double shear = 1.0;
};

Measures measure(const Triangle& t, std::span<const Vector3d> positions,
                 std::span<const Vector2d> points) {
  const Vector3d u = positions[t[1]] - positions[t[0]];
  const Vector3d v = positions[t[2]] - positions[t[0]];
  Matrix2d plane;
  plane << points[t[1]] - points[t[0]], points[t[2]] - points[t[0]];
  Measures measures;
  measures.surface_area = 0.5 * u.cross(v).norm();
  measures.plane_area = 0.5 * std::abs(plane.determinant());
  // The first fundamental form is J'J with J = [u v] plane^-1. Its trace and determinant are the
  // sum and the product of its eigenvalues G^2 and g^2.
  Matrix2d gram;
  gram << u.squaredNorm(), u.dot(v), u.dot(v), v.squaredNorm();
  const Matrix2d inverse = plane.inverse();
  measures.squared_stretch = 0.5 * (inverse.transpose() * gram * inverse).trace();
  const double product = measures.surface_area / measures.plane_area;
  const double ratio = measures.squared_stretch / product;
  measures.shear = ratio + std::sqrt(std::max(0.0, (ratio - 1.0) * (ratio + 1.0)));
  return measures;
}

}  // namespace

MapDistortion measure_distortion(std::span<const Triangle> triangles,
                                 std::span<const Vector3d> positions,
                                 std::span<const Vector2d> points) {
  MapDistortion distortion;
  double surface_area = 0.0;
  double plane_area = 0.0;
  double squared_stretch = 0.0;
  double largest = 0.0;
  double shear = 0.0;
  CancelCheck cancel_check;
  for (const Triangle& t : triangles) {
    cancel_check();
    const Measures m = measure(t, positions, points);
    if (!(m.surface_area > 0.0) || !std::isfinite(m.squared_stretch) || !std::isfinite(m.shear)) {
      continue;
    }
    surface_area += m.surface_area;
    plane_area += m.plane_area;
    squared_stretch += m.surface_area * m.squared_stretch;
    largest = std::max(largest, m.squared_stretch);
    shear += m.surface_area * m.shear;
    distortion.largest_shear = std::max(distortion.largest_shear, m.shear);
  }
  if (!(surface_area > 0.0)) return distortion;
  const double size_ratio = plane_area / surface_area;
  distortion.stretch = std::sqrt(squared_stretch / surface_area * size_ratio);
  distortion.largest_stretch = std::sqrt(largest * size_ratio);
  distortion.shear = shear / surface_area;
  return distortion;
}

}  // namespace lapwing
