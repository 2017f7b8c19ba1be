#include "lapwing/laplacian/ring_fit.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Returns the mean of K_i relative to v_i. Summing differences avoids a loss of precision far from
// the origin.
Vector3d ring_center(Index i, std::span<const Index> ring, std::span<const Vector3d> positions) {
  Vector3d sum = Vector3d::Zero();
  for (const Index j : ring) sum += positions[j] - positions[i];
  return sum / static_cast<double>(ring.size() + 1);
}

// If C has rank 1, J = S I - C has the eigenvalue 0 along the ring's line and S across it.
Matrix3d pseudo_inverse_on_line(const Matrix3d& C, double S) {
  Eigen::Index widest = 0;
  C.diagonal().maxCoeff(&widest);
  const Vector3d line = C.col(widest).normalized();
  return (Matrix3d::Identity() - line * line.transpose()) / S;
}

}  // namespace

Matrix3d inverse_cholesky_factor(const Matrix3d& K) {
  const double least = kCollinearShare * K.trace();
  Matrix3d F = Matrix3d::Zero();
  Matrix3d inverse = Matrix3d::Zero();
  for (Eigen::Index c = 0; c < 3; ++c) {
    const double pivot = K(c, c) - F.row(c).head(c).squaredNorm();
    if (!(pivot > least)) continue;
    F(c, c) = std::sqrt(pivot);
    for (Eigen::Index r = c + 1; r < 3; ++r) {
      F(r, c) = (K(r, c) - F.row(r).head(c).dot(F.row(c).head(c))) / F(c, c);
    }
    inverse(c, c) = 1.0 / F(c, c);
    inverse.row(c).head(c) = -F.row(c).head(c) * inverse.topLeftCorner(c, c) / F(c, c);
  }
  return inverse;
}

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

RingFit fit_ring(Index i, std::span<const Index> ring, std::span<const Vector3d> positions) {
  RingFit fit;
  fit.center = ring_center(i, ring, positions);
  Matrix3d C = fit.center * fit.center.transpose();
  for (const Index j : ring) {
    const Vector3d x = positions[j] - positions[i] - fit.center;
    C += x * x.transpose();
  }
  const double S = C.trace();
  if (!(S > 0.0)) return fit;
  fit.inverse_S = 1.0 / S;
  const Matrix3d J = Matrix3d::Identity() - C / S;
  // Here J is divided by S. Its two larger eigenvalues are between 1/2 and 1, so the determinant is
  // between a quarter of the smallest eigenvalue and the smallest eigenvalue.
  const double determinant = J.determinant();
  fit.inverse_J =
      determinant > kCollinearShare ? Matrix3d(J.inverse() / S) : pseudo_inverse_on_line(C, S);
  return fit;
}

namespace {

// H = sum_k v'_k x_k' and size = sum_k |x_k|^2 over K_i.
struct RingMoments {
  Matrix3d H = Matrix3d::Zero();
  double size = 0.0;
};

RingMoments ring_moments(Index i, std::span<const Index> ring, std::span<const Vector3d> rest,
                         std::span<const Vector3d> current) {
  // The x_k sum to 0 over K_i, so the v'_k need not be centred. They are taken relative to v'_i, so
  // the term of i is 0.
  const Vector3d center = ring_center(i, ring, rest);
  RingMoments sums;
  sums.size = center.squaredNorm();
  for (const Index j : ring) {
    const Vector3d x = rest[j] - rest[i] - center;
    sums.H += (current[j] - current[i]) * x.transpose();
    sums.size += x.squaredNorm();
  }
  return sums;
}

}  // namespace

RingSimilarity fit_similarity(Index i, std::span<const Index> ring, std::span<const Vector3d> rest,
                              std::span<const Vector3d> current) {
  const auto [H, size] = ring_moments(i, ring, rest, current);
  RingSimilarity fit{nearest_rotation(H)};
  // s = (sum of v'_k . R x_k) / (sum of |x_k|^2).
  if (size > 0.0) fit.scale = fit.R.cwiseProduct(H).sum() / size;
  return fit;
}

Matrix3d fit_rotation(Index i, std::span<const Index> ring, std::span<const Vector3d> rest,
                      std::span<const Vector3d> current) {
  return fit_similarity(i, ring, rest, current).R;
}

Matrix3d fit_rotation(Index i, std::span<const Index> ring, std::span<const Vector3d> rest,
                      std::span<const Vector3d> current, const Matrix3d& stretch) {
  return nearest_rotation(ring_moments(i, ring, rest, current).H * stretch);
}

}  // namespace lapwing
