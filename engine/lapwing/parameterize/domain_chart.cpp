#include "lapwing/parameterize/domain_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/planar.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

// Largest allowed distance of a boundary vertex from the circle or rectangle, relative to its size.
constexpr double kTolerance = 1e-6;

// Returns whether each boundary edge is on one side of the box around `centre` with these half
// sizes.
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

constexpr double kLemniscate = 2.622057554292119464840;

// Returns the lemniscate sine at kLemniscate * t / pi, by its Fourier series
//   2 pi / kLemniscate * sum_n (-1)^n sin((2n + 1) t) / cosh((n + 1/2) pi).
double lemniscate_sine(double t) {
  static const auto coefficients = [] {
    std::array<double, 12> c{};
    for (std::size_t n = 0; n < c.size(); ++n) {
      const double sign = n % 2 == 0 ? 1.0 : -1.0;
      c[n] = sign * 2.0 * std::numbers::pi / kLemniscate /
             std::cosh((static_cast<double>(n) + 0.5) * std::numbers::pi);
    }
    return c;
  }();
  // Clenshaw's summation: sin((2n + 3) t) = 2 cos(2t) sin((2n + 1) t) - sin((2n - 1) t).
  const double sine = std::sin(t);
  const double twice_cosine = 2.0 - 4.0 * sine * sine;
  double last = 0.0;
  double sum = 0.0;
  for (std::size_t n = coefficients.size(); n-- > 0;) {
    const double next = coefficients[n] + twice_cosine * sum - last;
    last = sum;
    sum = next;
  }
  return sine * (sum + last);
}

// Maps the square [-1, 1]^2 by the lemniscate sine, after a rotation by 45 degrees. The corners are
// mapped to +-1 and +-i. The real part, the imaginary part and 1 - |z|^2 follow from the addition
// theorems.
DomainChart::Place place_in_square(double x, double y) {
  constexpr double kQuarter = 0.25 * std::numbers::pi;
  const double s = lemniscate_sine(kQuarter * (x - y));
  const double t = lemniscate_sine(kQuarter * (x + y));
  const double A = s * s;
  const double B = t * t;
  const double below = 1.0 - A * B;
  const Vector2d z(s * std::sqrt(std::max(0.0, 1.0 - B * B)),
                   t * std::sqrt(std::max(0.0, 1.0 - A * A)));
  const double sides = lemniscate_sine(2.0 * kQuarter * (1.0 - std::abs(x))) *
                       lemniscate_sine(2.0 * kQuarter * (1.0 - std::abs(y)));
  return {z / below, sides * (1.0 + A + B - A * B) / below};
}

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
        "the boundary of the domain is neither a circle nor an axis-aligned rectangle; map the "
        "patch to a disk or a square first");
  }
}

DomainChart::Place DomainChart::place(const Vector2d& point) const {
  const Vector2d p = (point - centre_).cwiseQuotient(half_size_);
  if (!is_rectangle_) return {p, std::max(0.0, 1.0 - p.squaredNorm())};
  return place_in_square(std::clamp(p.x(), -1.0, 1.0), std::clamp(p.y(), -1.0, 1.0));
}

}  // namespace lapwing
