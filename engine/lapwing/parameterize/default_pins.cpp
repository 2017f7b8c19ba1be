#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/domain_map.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Moments closer to each other, or to 0, than this share of their size tell no direction: the shape
// is symmetric, and rounding would choose.
constexpr double kSymmetric = 1e-6;

double area_of(const Triangle& t, std::span<const Vector3d> positions) {
  return 0.5 * (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]).norm();
}

// A point of a triangle and its share of the area.
struct Sample {
  Vector3d position;
  double area;
};

// Six points a triangle that integrate polynomials of degree 4 exactly (Dunavant 1985).
std::vector<Sample> sample_area(const Patch& patch, std::span<const Vector3d> positions) {
  constexpr std::array<std::array<double, 2>, 2> kOrbits{
      {{0.445948490915965, 0.223381589678011}, {0.091576213509771, 0.109951743655322}}};
  std::vector<Sample> samples;
  samples.reserve(6 * patch.triangles.size());
  for (const Triangle& t : patch.triangles) {
    const std::array corners{positions[t[0]], positions[t[1]], positions[t[2]]};
    const double area = area_of(t, positions);
    for (const auto& [place, weight] : kOrbits) {
      const Vector3d common = place * (corners[0] + corners[1] + corners[2]);
      for (const Vector3d& corner : corners) {
        samples.push_back({common + (1.0 - 3.0 * place) * corner, weight * area});
      }
    }
  }
  return samples;
}

// A patch seen from above: right-handed axes through its center of area.
struct View {
  Vector3d center = Vector3d::Zero();
  Vector3d normal = Vector3d::UnitZ();
  std::array<Vector3d, 2> axes{Vector3d::UnitX(), Vector3d::UnitY()};

  Vector2d operator()(const Vector3d& p) const {
    return {axes[0].dot(p - center), axes[1].dot(p - center)};
  }
  // Turns the axes about the normal.
  void turn(double angle) {
    const Vector3d first = std::cos(angle) * axes[0] + std::sin(angle) * axes[1];
    axes = {first, normal.cross(first)};
  }
};

// Of the items, the one of the largest score; of those as good up to rounding, the smallest, so
// that the choice survives a motion.
template <class Score>
Index best_of(std::span<const Index> items, double scale, const Score& score) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Index item : items) best = std::max(best, score(item));
  Index chosen = kNoIndex;
  for (const Index item : items) {
    if (score(item) >= best - kSymmetric * scale) chosen = std::min(chosen, item);
  }
  return chosen;
}

class PrincipalView {
 public:
  PrincipalView(const Patch& patch, std::span<const Vector3d> positions)
      : patch_(patch), positions_(positions), samples_(sample_area(patch, positions)) {
    place_center();
    look_along_normal();
    turn_to_principal_direction();
    choose_sign();
  }

  Vector2d operator()(Index v) const { return view_(positions_[v]); }
  double radius() const { return radius_; }

 private:
  void place_center() {
    double area = 0.0;
    for (const Sample& s : samples_) {
      view_.center += s.area * s.position;
      area += s.area;
    }
    view_.center /= area;
    for (const Vector3d& p : positions_) radius_ = std::max(radius_, (p - view_.center).norm());
    for (const Sample& s : samples_) {
      covariance_ += s.area * (s.position - view_.center) * (s.position - view_.center).transpose();
    }
    area_ = area;
  }

  // The mean normal; of a patch that nearly closes, the direction it extends least in.
  void look_along_normal() {
    Vector3d normal = Vector3d::Zero();
    for (const auto& [a, b, c] : patch_.triangles) {
      normal += 0.5 * (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]);
    }
    if (!(normal.norm() > kSymmetric * area_)) {
      normal = Eigen::SelfAdjointEigenSolver<Matrix3d>(covariance_).eigenvectors().col(0);
      if (normal.dot(positions_[patch_.loop.front()] - view_.center) < 0.0) normal = -normal;
    }
    view_.normal = normal.normalized();
    // Until they are turned, the axes follow the boundary vertex that seems farthest from here.
    const auto seen = [&](Index v) {
      const Vector3d p = positions_[v] - view_.center;
      return Vector3d(p - p.dot(view_.normal) * view_.normal);
    };
    const Index farthest = best_of(patch_.loop, radius_, [&](Index v) { return seen(v).norm(); });
    const Vector3d first = seen(farthest);
    view_.axes[0] =
        first.norm() > kSymmetric * radius_ ? first.normalized() : view_.normal.unitOrthogonal();
    view_.axes[1] = view_.normal.cross(view_.axes[0]);
  }

  // Sum of area (x + i y)^`power` over the patch, |x + i y|^(2 `rounds`) beside it.
  std::complex<double> moment(int power, int rounds = 0) const {
    std::complex<double> sum = 0.0;
    for (const Sample& s : samples_) {
      const Vector2d p = view_(s.position) / radius_;
      const std::complex<double> z(p.x(), p.y());
      sum += s.area / area_ * std::pow(z, power) * std::pow(std::norm(z), rounds);
    }
    return sum;
  }

  void turn_to_principal_direction() {
    const double size = moment(0, 1).real();
    const std::complex<double> second = moment(2);
    if (std::abs(second) > kSymmetric * size) {
      view_.turn(0.5 * std::arg(second));
      return;
    }
    // Equally wide all around, as a square is: then along its sides. One that is equally wide still
    // keeps the axes it has.
    const std::complex<double> fourth = moment(4);
    if (std::abs(fourth) <= kSymmetric * size * size) return;
    view_.turn(0.25 * (std::arg(fourth) + std::numbers::pi));
    // Of the four ways, the one with the first boundary vertex at the lower left. Its quadrant is
    // taken a little turned, for a vertex in the middle of a side.
    const Vector2d first = (*this)(patch_.loop.front());
    const double quarter = 0.5 * std::numbers::pi;
    const double angle = std::atan2(first.y(), first.x()) + std::numbers::pi - 0.2 * quarter;
    view_.turn(quarter * std::floor(angle / quarter));
  }

  // Toward the heavier tail; without one, away from the first boundary vertex that is on one side.
  void choose_sign() {
    double tail = 0.0;
    for (const Sample& s : samples_) {
      const double x = view_(s.position).x() / radius_;
      tail += s.area / area_ * x * x * x;
    }
    if (std::abs(tail) <= kSymmetric) {
      tail = 0.0;
      for (const Index v : patch_.loop) {
        const double x = (*this)(v).x();
        if (tail == 0.0 && std::abs(x) > kSymmetric * radius_) tail = -x;
      }
    }
    if (tail < 0.0) view_.axes = {-view_.axes[0], -view_.axes[1]};
  }

  const Patch& patch_;
  std::span<const Vector3d> positions_;
  std::vector<Sample> samples_;
  View view_;
  Matrix3d covariance_ = Matrix3d::Zero();
  double area_ = 0.0;
  double radius_ = 0.0;
};

// The vertices of the loop a quarter of its length apart, from place `first` on.
BoundaryPins quarters(const Patch& patch, std::span<const Vector3d> positions, std::size_t first) {
  const std::size_t n = patch.loop.size();
  const auto at = [&](std::size_t k) { return patch.loop[(first + k) % n]; };
  std::vector<double> passed(n + 1, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    passed[k + 1] = passed[k] + (positions[at(k + 1)] - positions[at(k)]).norm();
  }
  BoundaryPins pins{at(0)};
  std::size_t k = 0;
  for (std::size_t pin = 1; pin < 4; ++pin) {
    // Later pins need a vertex each, too.
    const double wanted = 0.25 * static_cast<double>(pin) * passed[n];
    do ++k;
    while (passed[k] < wanted && k + 4 < n + pin);
    pins.push_back(at(k));
  }
  return pins;
}

// The vertices of the loop next to the corners of the rectangle around it.
BoundaryPins corner_pins(const Patch& patch, const PrincipalView& view) {
  Eigen::AlignedBox2d box;
  for (const Index v : patch.loop) box.extend(view(v));
  using Box = Eigen::AlignedBox2d;
  BoundaryPins pins;
  for (const auto corner : {Box::BottomLeft, Box::BottomRight, Box::TopRight, Box::TopLeft}) {
    const Vector2d p = box.corner(corner);
    pins.push_back(
        best_of(patch.loop, view.radius(), [&](Index v) { return -(view(v) - p).norm(); }));
  }
  return pins;
}

std::size_t place_of(const Patch& patch, Index pin) {
  return static_cast<std::size_t>(std::find(patch.loop.begin(), patch.loop.end(), pin) -
                                  patch.loop.begin());
}

// Whether the pins are different and follow each other in one round.
bool are_in_order(const Patch& patch, const BoundaryPins& pins) {
  const std::size_t n = patch.loop.size();
  const std::size_t first = place_of(patch, pins[0]);
  std::size_t last = 0;
  for (std::size_t k = 1; k < pins.size(); ++k) {
    const std::size_t step = (place_of(patch, pins[k]) + n - first) % n;
    if (step <= last) return false;
    last = step;
  }
  return true;
}

}  // namespace

BoundaryPins default_pins(const Patch& patch, std::span<const Vector3d> own_positions,
                          Domain domain) {
  if (domain == Domain::square && patch.loop.size() < 4) {
    throw InputError("the square needs 4 boundary vertices and the patch around vertex " +
                     std::to_string(patch.vertices.front()) + " has " +
                     std::to_string(patch.loop.size()) + "; take the disk, or a larger region");
  }
  double area = 0.0;
  for (const Triangle& t : patch.triangles) area += area_of(t, own_positions);
  // A patch without area, or one that is not finite, is refused where it is mapped.
  if (!(area > 0.0) || !std::isfinite(area)) {
    if (domain == Domain::disk) return {patch.loop.front()};
    return quarters(patch, own_positions, 0);
  }
  const PrincipalView view(patch, own_positions);
  if (domain == Domain::disk) {
    return {best_of(patch.loop, view.radius(), [&](Index v) { return view(v).x(); })};
  }
  BoundaryPins pins = corner_pins(patch, view);
  if (are_in_order(patch, pins)) return pins;
  return quarters(patch, own_positions, place_of(patch, pins[0]));
}

}  // namespace lapwing
