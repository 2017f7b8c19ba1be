#include "lapwing/parameterize/principal_view.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "lapwing/base/cancellation.h"
#include "lapwing/laplacian/decompositions.h"

namespace lapwing {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

PrincipalView::PrincipalView(const Patch& patch, std::span<const Vector3d> own_positions)
    : patch_(patch), positions_(own_positions) {
  sample_area();
  place_center();
  look_along_normal();
  turn_to_principal_direction();
  choose_sign();
}

// Six points per triangle that integrate polynomials of degree 4 exactly (Dunavant 1985).
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

// Looks along the mean normal or, if the patch nearly closes, along its least extent.
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
  // Before they are turned, the axes follow the boundary vertex that appears farthest away.
  const auto flat = [&](Index v) {
    const Vector3d p = positions_[v] - center_;
    return Vector3d(p - p.dot(normal_) * normal_);
  };
  const Vector3d first =
      flat(best_of(patch_.loop, radius_, [&](Index v) { return flat(v).norm(); }));
  axes_[0] = first.norm() > kSymmetric * radius_ ? first.normalized() : normal_.unitOrthogonal();
  axes_[1] = normal_.cross(axes_[0]);
}

// Turns the axes about the normal.
void PrincipalView::turn(double angle) {
  const Vector3d first = std::cos(angle) * axes_[0] + std::sin(angle) * axes_[1];
  axes_ = {first, normal_.cross(first)};
}

// Returns the mean of z^power |z|^(2 rounds) over the patch, z = x + i y, in units of the radius.
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
  // The patch is equally wide all around, like a square, so the axes follow its sides. If the
  // fourth moment gives no direction either, they stay as they are.
  const std::complex<double> fourth = moment(4);
  if (std::abs(fourth) <= kSymmetric * size * size) return;
  turn(0.25 * (std::arg(fourth) + std::numbers::pi));
  // Of the four directions, take the one with the first boundary vertex at the lower left. That
  // quadrant is rotated a little, so that a vertex in the middle of a side is not at its limit.
  const Vector2d first = (*this)(patch_.loop.front());
  const double quarter = 0.5 * std::numbers::pi;
  const double angle = std::atan2(first.y(), first.x()) + std::numbers::pi - 0.2 * quarter;
  turn(quarter * std::floor(angle / quarter));
}

// Points the first axis to the heavier tail or, without one, away from the first boundary vertex
// that is on one side.
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

}  // namespace lapwing
