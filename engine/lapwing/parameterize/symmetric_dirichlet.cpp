#include "lapwing/parameterize/symmetric_dirichlet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/LU>

#include "lapwing/base/parallel.h"
#include "lapwing/parameterize/planar.h"

namespace lapwing {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// Lower bound of a triangle's weight, as a fraction of the mean area.
constexpr double kMinWeight = 1e-3;

Matrix2d edges(const Triangle& t, std::span<const Vector2d> points) {
  Matrix2d columns;
  columns.col(0) = points[t[1]] - points[t[0]];
  columns.col(1) = points[t[2]] - points[t[0]];
  return columns;
}

// J = U diag(s) V' with rotations U and V and s_0 >= s_1. Both are positive if det J is positive.
struct SignedSvd {
  Matrix2d U;
  Matrix2d V;
  Vector2d s;
};

Matrix2d rotation(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return (Matrix2d() << c, -s, s, c).finished();
}

// `det` is passed separately, because computing it from J suffers from cancellation for slivers.
SignedSvd signed_svd(const Matrix2d& J, double det) {
  // J is (s_0 + s_1) / 2 times a rotation plus (s_0 - s_1) / 2 times a reflection.
  const Vector2d turn(J(0, 0) + J(1, 1), J(1, 0) - J(0, 1));
  const Vector2d mirror(J(0, 0) - J(1, 1), J(1, 0) + J(0, 1));
  const double turn_angle = std::atan2(turn.y(), turn.x());
  const double mirror_angle = std::atan2(mirror.y(), mirror.x());
  const double largest = 0.5 * (turn.norm() + mirror.norm());
  return {rotation(0.5 * (mirror_angle + turn_angle)), rotation(0.5 * (mirror_angle - turn_angle)),
          Vector2d(largest, det / largest)};
}

}  // namespace

SymmetricDirichlet::SymmetricDirichlet(std::span<const Triangle> triangles,
                                       std::span<const Vector2d> rest)
    : triangles_(triangles) {
  double total = 0.0;
  for (const Triangle& t : triangles) {
    inverse_edges_.push_back(edges(t, rest).inverse());
    areas_.push_back(doubled_area(t, rest));
    total += areas_.back();
  }
  const double floor = kMinWeight * total / static_cast<double>(triangles.size());
  weights_ = areas_;
  total = 0.0;
  for (double& weight : weights_) total += weight = std::max(weight, floor);
  for (double& weight : weights_) weight /= total;
}

Matrix2d SymmetricDirichlet::jacobian(std::size_t triangle,
                                      std::span<const Vector2d> points) const {
  return edges(triangles_[triangle], points) * inverse_edges_[triangle];
}

double SymmetricDirichlet::energy_of(std::size_t triangle, std::span<const Vector2d> points) const {
  const double det = doubled_area(triangles_[triangle], points) / areas_[triangle];
  if (!(det > 0.0)) return std::numeric_limits<double>::infinity();
  // |J^-1|^2 = |J|^2 / det^2 in the plane.
  return 0.5 * weights_[triangle] * jacobian(triangle, points).squaredNorm() *
         (1.0 + 1.0 / (det * det));
}

double SymmetricDirichlet::energy(std::span<const Vector2d> points) const {
  // Sum by task, so that the result does not depend on the number of threads.
  constexpr std::size_t kTrianglesPerTask = 2048;
  const std::size_t tasks = (size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
  std::vector<double> sums(tasks, 0.0);
  parallel_for(tasks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t last = std::min(size(), (task + 1) * kTrianglesPerTask);
      for (std::size_t t = task * kTrianglesPerTask; t < last; ++t) {
        sums[task] += energy_of(t, points);
      }
    }
  });
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum;
}

SymmetricDirichlet::Part SymmetricDirichlet::part(std::size_t triangle,
                                                  std::span<const Vector2d> points) const {
  const auto [U, V, s] = signed_svd(jacobian(triangle, points),
                                    doubled_area(triangles_[triangle], points) / areas_[triangle]);
  const double weight = weights_[triangle];
  // The derivative of J with respect to coordinate c of corner k is e_c times row k of `slopes`.
  Eigen::Matrix<double, 3, 2> slopes;
  slopes.bottomRows<2>() = inverse_edges_[triangle];
  slopes.row(0) = -slopes.row(1) - slopes.row(2);

  const Vector2d slope(s[0] - std::pow(s[0], -3), s[1] - std::pow(s[1], -3));
  const Matrix2d stress = U * slope.asDiagonal() * V.transpose();
  Part part;
  for (int k = 0; k < 3; ++k) {
    part.gradient.segment<2>(2 * k) = weight * stress * slopes.row(k).transpose();
  }

  // Eigenvectors of the Hessian with respect to J (Smith, De Goes and Kim 2019, §4): two scaling
  // modes, flip and twist. Only the twist can have a negative eigenvalue.
  const double p = s[0] * s[1];
  const double p3 = p * p * p;
  const double squares = s.squaredNorm();
  const double root = std::sqrt(0.5);
  const auto mode = [&U = U, &V = V](double a, double b, double c, double d) {
    return Matrix2d(U * (Matrix2d() << a, b, c, d).finished() * V.transpose());
  };
  const std::array<Matrix2d, 4> modes{mode(1, 0, 0, 0), mode(0, 0, 0, 1), mode(0, root, root, 0),
                                      mode(0, -root, root, 0)};
  const std::array<double, 4> stiffness{1.0 + 3.0 * std::pow(s[0], -4),
                                        1.0 + 3.0 * std::pow(s[1], -4), 1.0 + (squares + p) / p3,
                                        std::max(0.0, 1.0 - (squares - p) / p3)};
  part.hessian.setZero();
  for (std::size_t m = 0; m < modes.size(); ++m) {
    Eigen::Vector<double, 6> direction;
    for (int k = 0; k < 3; ++k) {
      direction.segment<2>(2 * k) = modes[m] * slopes.row(k).transpose();
    }
    part.hessian += weight * stiffness[m] * direction * direction.transpose();
  }
  return part;
}

}  // namespace lapwing
