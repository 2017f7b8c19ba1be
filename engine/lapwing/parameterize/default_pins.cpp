#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/laplacian/decompositions.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/parameterize/patch.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// If moments differ from each other or from 0 by less than this fraction of their size, the shape
// is treated as symmetric. Such moments are not used to choose a direction, because the choice
// would depend on rounding errors.
constexpr double kSymmetric = 1e-6;

// Projects a patch along its mean normal. The origin is the centre of area, so the area of the
// patch must be positive. The axes are the principal directions, the wider one first, and form a
// right-handed frame. The frame rotates, translates and scales with the patch. If symmetry makes
// the axes ambiguous, the indices of the boundary vertices determine them. The arguments must
// outlive the object.
class PrincipalView {
 public:
  PrincipalView(const Patch& patch, std::span<const Eigen::Vector3d> own_positions);

  // Returns the projected position of vertex `v` of the patch.
  Eigen::Vector2d operator()(Index v) const { return seen(positions_[v]); }
  // Returns the largest distance of a vertex from the centre of area.
  double radius() const { return radius_; }

 private:
  struct Sample {
    Eigen::Vector3d position;
    double area;
  };

  void sample_area();
  void place_center();
  void look_along_normal();
  void turn_to_principal_direction();
  void choose_sign();

  Eigen::Vector2d seen(const Eigen::Vector3d& p) const {
    return {axes_[0].dot(p - center_), axes_[1].dot(p - center_)};
  }
  void turn(double angle);
  std::complex<double> moment(int power, int rounds = 0) const;

  const Patch& patch_;
  std::span<const Eigen::Vector3d> positions_;
  std::vector<Sample> samples_;  //< quadrature points on the patch, each with its area
  double area_ = 0.0;
  double radius_ = 0.0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ();
  std::array<Eigen::Vector3d, 2> axes_{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
};

// Returns the item with the largest score. If several scores are equal up to rounding errors of
// numbers of size `scale`, returns the smallest of these items. The choice is therefore invariant
// under rigid motions.
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

PrincipalView::PrincipalView(const Patch& patch, std::span<const Vector3d> own_positions)
    : patch_(patch), positions_(own_positions) {
  sample_area();
  place_center();
  look_along_normal();
  turn_to_principal_direction();
  choose_sign();
}

// Uses six quadrature points per triangle, exact for polynomials of degree 4 (Dunavant 1985).
void PrincipalView::sample_area() {
  constexpr std::array<std::array<double, 2>, 2> kOrbits{
      {{0.445948490915965, 0.223381589678011}, {0.091576213509771, 0.109951743655322}}};
  samples_.reserve(6 * patch_.triangles.size());
  CancelCheck cancel_check;
  for (const Triangle& t : patch_.triangles) {
    cancel_check();
    const std::array corners{positions_[t[0]], positions_[t[1]], positions_[t[2]]};
    const double area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
    area_ += area;
    for (const auto& [place, weight] : kOrbits) {
      const Vector3d common = place * (corners[0] + corners[1] + corners[2]);
      for (const Vector3d& corner : corners) {
        samples_.push_back({common + (1.0 - 3.0 * place) * corner, weight * area});
      }
    }
  }
}

void PrincipalView::place_center() {
  double area = 0.0;
  for (const Sample& s : samples_) {
    center_ += s.area * s.position;
    area += s.area;
  }
  center_ /= area;
  for (const Vector3d& p : positions_) radius_ = std::max(radius_, (p - center_).norm());
}

// Projects along the mean normal or, if the patch is nearly closed, along the direction of its
// smallest extent.
void PrincipalView::look_along_normal() {
  Vector3d normal = Vector3d::Zero();
  for (const auto& [a, b, c] : patch_.triangles) {
    normal += 0.5 * (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]);
  }
  if (!(normal.norm() > kSymmetric * area_)) {
    Matrix3d covariance = Matrix3d::Zero();
    for (const Sample& s : samples_) {
      covariance += s.area * (s.position - center_) * (s.position - center_).transpose();
    }
    normal = symmetric_eigenvectors(covariance).vectors.col(0);
    if (normal.dot(positions_[patch_.loop.front()] - center_) < 0.0) normal = -normal;
  }
  normal_ = normal.normalized();
  // The first axis initially points to the boundary vertex that is farthest from the centre in the
  // projection.
  const auto flat = [&](Index v) {
    const Vector3d p = positions_[v] - center_;
    return Vector3d(p - p.dot(normal_) * normal_);
  };
  const Vector3d first =
      flat(best_of(patch_.loop, radius_, [&](Index v) { return flat(v).norm(); }));
  axes_[0] = first.norm() > kSymmetric * radius_ ? first.normalized() : normal_.unitOrthogonal();
  axes_[1] = normal_.cross(axes_[0]);
}

void PrincipalView::turn(double angle) {
  const Vector3d first = std::cos(angle) * axes_[0] + std::sin(angle) * axes_[1];
  axes_ = {first, normal_.cross(first)};
}

// Returns the mean of z^power |z|^(2 rounds) over the patch, where z = (x + i y) / radius.
std::complex<double> PrincipalView::moment(int power, int rounds) const {
  std::complex<double> sum = 0.0;
  CancelCheck cancel_check;
  for (const Sample& s : samples_) {
    cancel_check();
    const Vector2d p = seen(s.position) / radius_;
    const std::complex<double> z(p.x(), p.y());
    sum += s.area / area_ * std::pow(z, power) * std::pow(std::norm(z), rounds);
  }
  return sum;
}

void PrincipalView::turn_to_principal_direction() {
  const double size = moment(0, 1).real();
  const std::complex<double> second = moment(2);
  if (std::abs(second) > kSymmetric * size) {
    turn(0.5 * std::arg(second));
    return;
  }
  // The second moments are isotropic, as for a square, so the fourth moment aligns the axes with
  // the sides. If it is isotropic as well, the axes do not change.
  const std::complex<double> fourth = moment(4);
  if (std::abs(fourth) <= kSymmetric * size * size) return;
  turn(0.25 * (std::arg(fourth) + std::numbers::pi));
  // Of the four possible orientations, choose the one with the first boundary vertex in the lower
  // left quadrant. The quadrant is slightly rotated, so that the middle of a side is not on its
  // border.
  const Vector2d first = (*this)(patch_.loop.front());
  const double quarter = 0.5 * std::numbers::pi;
  const double angle = std::atan2(first.y(), first.x()) + std::numbers::pi - 0.2 * quarter;
  turn(quarter * std::floor(angle / quarter));
}

// Orients the first axis by the sign of the third moment. If this is 0, the axis points away from
// the first boundary vertex that is not in the middle.
void PrincipalView::choose_sign() {
  double tail = 0.0;
  for (const Sample& s : samples_) {
    const double x = seen(s.position).x() / radius_;
    tail += s.area / area_ * x * x * x;
  }
  if (std::abs(tail) <= kSymmetric) {
    tail = 0.0;
    for (const Index v : patch_.loop) {
      const double x = (*this)(v).x();
      if (tail == 0.0 && std::abs(x) > kSymmetric * radius_) tail = -x;
    }
  }
  if (tail < 0.0) axes_ = {-axes_[0], -axes_[1]};
}

// Returns four vertices at quarters of the loop's length, starting at position `first` of the loop.
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
    // Leave one vertex for each later pin.
    const double wanted = 0.25 * static_cast<double>(pin) * passed[n];
    do ++k;
    while (passed[k] < wanted && k + 4 < n + pin);
    pins.push_back(at(k));
  }
  return pins;
}

// Returns the loop vertices nearest to the corners of the bounding rectangle of the loop.
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

// Returns whether the pins are distinct and in the order of the loop.
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
    throw InputError("the square needs 4 boundary vertices, but the patch around vertex " +
                     std::to_string(patch.vertices.front()) + " has " +
                     std::to_string(patch.loop.size()) + "; use the disk, or a larger region");
  }
  double area = 0.0;
  for (const auto& [a, b, c] : patch.triangles) {
    area += 0.5 *
            (own_positions[b] - own_positions[a]).cross(own_positions[c] - own_positions[a]).norm();
  }
  // `mean_value_map` rejects a patch without area, or one that is not finite.
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
