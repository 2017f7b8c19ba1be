#include "lapwing/laplacian/ring_fit.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Mean of K_i relative to v_i. Differences first: positions far from the origin lose nothing.
Vector3d ring_center(Index i, std::span<const Index> ring, std::span<const Vector3d> positions) {
  Vector3d sum = Vector3d::Zero();
  for (const Index j : ring) sum += positions[j] - positions[i];
  return sum / static_cast<double>(ring.size() + 1);
}

// J = S I - C of a spread C of rank 1 has the eigenvalue 0 along the ring's line and S across it.
Matrix3d pseudo_inverse_on_line(const Matrix3d& C, double S) {
  Eigen::Index widest = 0;
  C.diagonal().maxCoeff(&widest);
  const Vector3d line = C.col(widest).normalized();
  return (Matrix3d::Identity() - line * line.transpose()) / S;
}

}  // namespace

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
  // The two larger eigenvalues of J / S are at least 1/2 each and at most 1, so the determinant is
  // within a factor of four of the smallest eigenvalue.
  const double determinant = J.determinant();
  fit.inverse_J =
      determinant > kCollinearShare ? Matrix3d(J.inverse() / S) : pseudo_inverse_on_line(C, S);
  return fit;
}

LinearSimilarity fit_linear_similarity(Index i, std::span<const Index> ring,
                                       std::span<const Vector3d> rest,
                                       std::span<const Vector3d> current) {
  const RingFit fit = fit_ring(i, ring, rest);
  double dot = 0.0;
  Vector3d cross = Vector3d::Zero();
  for (const Index j : ring) {
    const Vector3d x = rest[j] - rest[i] - fit.center;
    const Vector3d moved = current[j] - current[i];
    dot += x.dot(moved);
    cross += x.cross(moved);
  }
  // The centre vertex itself has moved - current[i] = 0 and adds nothing.
  return {dot * fit.inverse_S, fit.inverse_J * cross};
}

Matrix3d fit_rotation(Index i, std::span<const Index> ring, std::span<const Vector3d> rest,
                      std::span<const Vector3d> current) {
  const Vector3d center = ring_center(i, ring, rest);
  const Vector3d current_center = ring_center(i, ring, current);
  Matrix3d H = current_center * center.transpose();
  for (const Index j : ring) {
    H += (current[j] - current[i] - current_center) * (rest[j] - rest[i] - center).transpose();
  }
  const double size = H.norm();
  if (!(size > 0.0) || !std::isfinite(size)) return Matrix3d::Identity();
  H /= size;
  const Eigen::JacobiSVD<Matrix3d> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector3d sigma = svd.singularValues();
  if (sigma(1) <= kCollinearShare * sigma(0)) {
    // Only the line's direction is known on both sides: turn it the shortest way.
    return Eigen::Quaterniond::FromTwoVectors(svd.matrixV().col(0), svd.matrixU().col(0))
        .toRotationMatrix();
  }
  Matrix3d U = svd.matrixU();
  if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

}  // namespace lapwing
