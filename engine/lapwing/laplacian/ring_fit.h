#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The fixed part of the least-squares fit of eq. 6-12 over K_i = {i} u N_i. In coordinates x_k
/// centred on the mean c of K_i, the 7 x 7 system A'A of eq. 12 is block diagonal (ENERGY.md
/// section 2):
///     s = sum_k x_k . v'_k / S         S = sum_k |x_k|^2
///     h = J^-1 sum_k x_k x v'_k        J = sum_k (|x_k|^2 I - x_k x_k')
/// If J is singular (a collinear ring), its pseudo-inverse is used. If S = 0, both inverses are
/// zero, so that T_i = 0 and the row is the plain Laplacian.
struct RingFit {
  Eigen::Vector3d center;  ///< c, relative to v_i
  double inverse_S = 0.0;  ///< 1 / S
  Eigen::Matrix3d inverse_J = Eigen::Matrix3d::Zero();
};

/// An eigenvalue of J below this share of S counts as zero.
inline constexpr double kCollinearShare = 1e-12;

/// Returns the fit of vertex `i` with neighbours `ring`.
RingFit fit_ring(Index i, std::span<const Index> ring, std::span<const Eigen::Vector3d> positions);

/// Returns the least-squares rotation of the ring K_i from rest to current (eq. 6 restricted to
/// rotations). The determinant is always +1. A ring without extent gives the identity, a collinear
/// ring the smallest rotation that carries its line.
Eigen::Matrix3d fit_rotation(Index i, std::span<const Index> ring,
                             std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> current);

/// The same from the rest shape stretched by the symmetric `stretch`.
Eigen::Matrix3d fit_rotation(Index i, std::span<const Index> ring,
                             std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> current,
                             const Eigen::Matrix3d& stretch);

/// That rotation, and the factor s for which s R fits the ring best; 1 for a ring without extent.
struct RingSimilarity {
  Eigen::Matrix3d R;
  double scale = 1.0;
};
RingSimilarity fit_similarity(Index i, std::span<const Index> ring,
                              std::span<const Eigen::Vector3d> rest,
                              std::span<const Eigen::Vector3d> current);

/// Returns F^-1 for the lower Cholesky factor F of K, positive semidefinite. A pivot of almost 0,
/// as for a collinear ring, leaves a row of zeros.
Eigen::Matrix3d inverse_cholesky_factor(const Eigen::Matrix3d& K);

/// Returns [v]x, the matrix with [v]x w = v x w.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

}  // namespace lapwing
