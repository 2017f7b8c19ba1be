#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The fixed part of the least-squares fit of eq. 6-12 over K_i = {i} u N_i, in coordinates centred
/// on the mean c of K_i. There the 7 x 7 system A'A of eq. 12 is block diagonal (ENERGY.md section
/// 2):
///     s = sum_k x_k . v'_k / S         S = sum_k |x_k|^2
///     h = J^-1 sum_k x_k x v'_k        J = sum_k (|x_k|^2 I - x_k x_k')
/// Where J is singular (a collinear ring) its pseudo-inverse stands in; where S = 0 both inverses
/// are zero, so that T_i = 0 and the row is the plain Laplacian.
struct RingFit {
  Eigen::Vector3d center;  ///< c, relative to v_i
  double inverse_S = 0.0;  ///< 1 / S
  Eigen::Matrix3d inverse_J = Eigen::Matrix3d::Zero();
};

/// An eigenvalue of J below this share of S counts as zero.
inline constexpr double kCollinearShare = 1e-12;

/// Fit of vertex `i` with neighbours `ring`.
RingFit fit_ring(Index i, std::span<const Index> ring, std::span<const Eigen::Vector3d> positions);

/// Best rotation of the ring K_i from rest to current, in the least-squares sense (eq. 6 restricted
/// to rotations): determinant +1 always; the identity for a ring without extent. A collinear ring
/// takes the smallest rotation that carries its line.
Eigen::Matrix3d fit_rotation(Index i, std::span<const Index> ring,
                             std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> current);

/// The same from the rest shape stretched by `stretch`, symmetric.
Eigen::Matrix3d fit_rotation(Index i, std::span<const Index> ring,
                             std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> current,
                             const Eigen::Matrix3d& stretch);

/// That rotation, and the factor s for which s R carries the ring best; 1 for a ring without
/// extent.
struct RingSimilarity {
  Eigen::Matrix3d R;
  double scale = 1.0;
};
RingSimilarity fit_similarity(Index i, std::span<const Index> ring,
                              std::span<const Eigen::Vector3d> rest,
                              std::span<const Eigen::Vector3d> current);

/// F^-1 for the lower Cholesky factor F of K, positive semidefinite. A pivot of next to nothing, as
/// a ring on a line has, leaves a row of zeros.
Eigen::Matrix3d inverse_cholesky_factor(const Eigen::Matrix3d& K);

/// [v]x: the matrix with [v]x w = v x w.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

}  // namespace lapwing
