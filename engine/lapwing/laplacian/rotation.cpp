// Based on: Horn, "Closed-form solution of absolute orientation using unit quaternions", 1987. The
// largest eigenvalue is found as in Theobald, "Rapid calculation of RMSDs using a quaternion-based
// characteristic polynomial", 2005.
#include "lapwing/laplacian/rotation.h"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lapwing/laplacian/decompositions.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;

// The second singular value counts as 0 below this fraction of the largest one.
constexpr double kRankOneShare = 1e-12;
// If the product of the distances to the other eigenvalues is smaller, the eigenvector loses half
// of its digits.
constexpr double kSmallestGap = 1e-6;
constexpr int kMostNewtonSteps = 40;
// If the vectors are opposite up to this angle (in radians), rounding errors would determine the
// axis.
constexpr double kOpposite = 1e-9;

Matrix3d rotation_by_svd(const Matrix3d& H) {
  auto [U, sigma, V] = singular_values(H);
  if (sigma(1) <= kRankOneShare * sigma(0)) return least_rotation(V.col(0), U.col(0));
  if (U.determinant() * V.determinant() < 0.0) U.col(2) = -U.col(2);
  return U * V.transpose();
}

// Horn's matrix: q'Nq = trace(R(q)' H).
Matrix4d quaternion_form(const Matrix3d& H) {
  Matrix4d N;
  N(0, 0) = H(0, 0) + H(1, 1) + H(2, 2);
  N(1, 1) = H(0, 0) - H(1, 1) - H(2, 2);
  N(2, 2) = -H(0, 0) + H(1, 1) - H(2, 2);
  N(3, 3) = -H(0, 0) - H(1, 1) + H(2, 2);
  N(0, 1) = N(1, 0) = H(2, 1) - H(1, 2);
  N(0, 2) = N(2, 0) = H(0, 2) - H(2, 0);
  N(0, 3) = N(3, 0) = H(1, 0) - H(0, 1);
  N(1, 2) = N(2, 1) = H(1, 0) + H(0, 1);
  N(1, 3) = N(3, 1) = H(0, 2) + H(2, 0);
  N(2, 3) = N(3, 2) = H(2, 1) + H(1, 2);
  return N;
}

// The largest root of N's characteristic polynomial l^4 + a l^2 + b l + c, for |H| = 1, and the
// polynomial's slope there. Newton's method from above descends to this root.
struct LargestRoot {
  double value = 0.0;
  double slope = 0.0;
};
LargestRoot largest_root(const Matrix3d& H) {
  Matrix3d cofactors;
  for (int k = 0; k < 3; ++k) {
    cofactors.col(k) = H.col((k + 1) % 3).cross(H.col((k + 2) % 3));
  }
  const double a = -2.0;
  const double b = -8.0 * H.col(0).dot(cofactors.col(0));
  const double c = 1.0 - 4.0 * cofactors.squaredNorm();
  const auto slope_at = [&](double l) { return (4.0 * l * l + 2.0 * a) * l + b; };
  // Upper bound of the sum of the singular values of a matrix with norm 1.
  double l = std::sqrt(3.0);
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const double slope = slope_at(l);
    if (!(slope > kSmallestGap)) break;
    const double down = (((l * l + a) * l + b) * l + c) / slope;
    l -= down;
    if (!(down > 1e-15)) break;
  }
  return {l, slope_at(l)};
}

double determinant_without(const Matrix4d& A, int row, int column) {
  std::array<int, 3> r{};
  std::array<int, 3> c{};
  for (int k = 0, i = 0, j = 0; k < 4; ++k) {
    if (k != row) r[static_cast<std::size_t>(i++)] = k;
    if (k != column) c[static_cast<std::size_t>(j++)] = k;
  }
  return A(r[0], c[0]) * (A(r[1], c[1]) * A(r[2], c[2]) - A(r[1], c[2]) * A(r[2], c[1])) -
         A(r[0], c[1]) * (A(r[1], c[0]) * A(r[2], c[2]) - A(r[1], c[2]) * A(r[2], c[0])) +
         A(r[0], c[2]) * (A(r[1], c[0]) * A(r[2], c[1]) - A(r[1], c[1]) * A(r[2], c[0]));
}

}  // namespace

Matrix3d nearest_rotation(const Matrix3d& given) {
  const double size = given.norm();
  if (!(size > 0.0) || !std::isfinite(size)) return Matrix3d::Identity();
  const Matrix3d H = given / size;
  const LargestRoot root = largest_root(H);
  if (!(root.slope > kSmallestGap)) return rotation_by_svd(H);
  // The adjugate of N - l I is a multiple of q q', so its column with the largest diagonal entry is
  // a multiple of q.
  const Matrix4d A = quaternion_form(H) - root.value * Matrix4d::Identity();
  int best = 0;
  double largest = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double diagonal = std::abs(determinant_without(A, k, k));
    if (diagonal > largest) {
      largest = diagonal;
      best = k;
    }
  }
  Eigen::Vector4d q;
  for (int k = 0; k < 4; ++k) {
    q[k] = ((k + best) % 2 == 0 ? 1.0 : -1.0) * determinant_without(A, k, best);
  }
  q.normalize();
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

Matrix3d least_rotation(const Vector3d& from, const Vector3d& to) {
  const Vector3d axis = from.cross(to);  // unit axis times 2 sin(a / 2) cos(a / 2) for an angle a
  Eigen::Quaterniond turn(1.0 + from.dot(to), axis.x(), axis.y(), axis.z());
  if (turn.norm() < kOpposite) turn = Eigen::AngleAxisd(std::numbers::pi, from.unitOrthogonal());
  return turn.normalized().toRotationMatrix();
}

Matrix3d polar_stretch(const Matrix3d& A) {
  const Eigenvectors3 squares = symmetric_eigenvectors(A.transpose() * A);
  const Vector3d stretches = squares.values.cwiseMax(0.0).cwiseSqrt().cwiseMax(kLeastStretch);
  return squares.vectors * stretches.asDiagonal() * squares.vectors.transpose();
}

}  // namespace lapwing
