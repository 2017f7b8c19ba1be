#include "lapwing/parameterize/domain_chart.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/planar.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

// How far from the circle or the rectangle, relative to its size, a boundary vertex may lie.
constexpr double kTolerance = 1e-6;

// Whether both ends of every side lie on one side of the box from -half_size to half_size.
bool follows_box(std::span<const Index> boundary, std::span<const Vector2d> points,
                 const Vector2d& centre, const Vector2d& half_size) {
  for (std::size_t k = 0; k < boundary.size(); ++k) {
    const Vector2d a = (points[boundary[k]] - centre).cwiseQuotient(half_size);
    const Vector2d b =
        (points[boundary[(k + 1) % boundary.size()]] - centre).cwiseQuotient(half_size);
    const auto on_side = [&](int axis, double side) {
      return std::abs(a[axis] - side) <= kTolerance && std::abs(b[axis] - side) <= kTolerance;
    };
    if (!on_side(0, -1.0) && !on_side(0, 1.0) && !on_side(1, -1.0) && !on_side(1, 1.0)) {
      return false;
    }
  }
  return true;
}

// The centre of the circle through three points.
Vector2d circumcentre(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  Eigen::Matrix2d chords;
  chords.row(0) = b - a;
  chords.row(1) = c - a;
  const Vector2d halves(0.5 * (b - a).squaredNorm(), 0.5 * (c - a).squaredNorm());
  return a + chords.inverse() * halves;
}

}  // namespace

DomainChart::DomainChart(std::span<const Index> boundary, std::span<const Vector2d> points) {
  if (boundary.size() < 3) {
    throw InputError("the boundary loop of the domain has " + std::to_string(boundary.size()) +
                     " vertices; it needs at least 3");
  }
  Vector2d low = points[boundary.front()];
  Vector2d high = low;
  for (const Index v : boundary) {
    low = low.cwiseMin(points[v]);
    high = high.cwiseMax(points[v]);
  }
  centre_ = 0.5 * (low + high);
  half_size_ = 0.5 * (high - low);
  is_rectangle_ = half_size_.minCoeff() > 0.0 && follows_box(boundary, points, centre_, half_size_);
  if (is_rectangle_) return;

  const std::size_t third = boundary.size() / 3;
  const Vector2d& first = points[boundary.front()];
  centre_ = circumcentre(first, points[boundary[third]], points[boundary[2 * third]]);
  const double radius = (first - centre_).norm();
  half_size_.setConstant(radius);
  const bool is_circle = std::all_of(boundary.begin(), boundary.end(), [&](Index v) {
    return std::abs((points[v] - centre_).norm() - radius) <= kTolerance * radius;
  });
  if (!is_circle) {
    throw InputError(
        "the boundary of the domain to warp is neither a circle nor a rectangle along the axes; "
        "lay the patch onto a disk or a square first");
  }
}

DomainChart::Place DomainChart::place(const Vector2d& point) const {
  const Vector2d p = (point - centre_).cwiseQuotient(half_size_);
  if (!is_rectangle_) return {p, std::max(0.0, 1.0 - p.squaredNorm())};
  const double x = std::clamp(p.x(), -1.0, 1.0);
  const double y = std::clamp(p.y(), -1.0, 1.0);
  return {{x * std::sqrt(1.0 - 0.5 * y * y), y * std::sqrt(1.0 - 0.5 * x * x)},
          (1.0 - x) * (1.0 + x) * (1.0 - y) * (1.0 + y)};
}

}  // namespace lapwing
