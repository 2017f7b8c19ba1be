#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The part of the least-squares fit of eq. 6-12 over K_i = {i} u N_i that depends only on the rest
/// shape. In coordinates x_k centred on the mean c of K_i, the 7 x 7 system A'A of eq. 12 is block
/// diagonal (ENERGY.md section 2):
///     s = sum_k x_k . v'_k / S         S = sum_k |x_k|^2
///     h = J^-1 sum_k x_k x v'_k        J = sum_k (|x_k|^2 I - x_k x_k')
/// If J is singular (a collinear ring), its pseudo-inverse is used. If S = 0, both inverses are 0,
/// so that T_i = 0 and the row is that of the Laplacian.
struct RingFit {
  Eigen::Vector3d center;  ///< c, relative to v_i
  double inverse_S = 0.0;  ///< 1 / S
  Eigen::Matrix3d inverse_J = Eigen::Matrix3d::Zero();
};

/// Eigenvalues of J below this fraction of S count as 0.
inline constexpr double kCollinearShare = 1e-12;

/// Returns the fit of vertex `i` with neighbours `ring`.
RingFit fit_ring(Index i, std::span<const Index> ring, std::span<const Eigen::Vector3d> positions);

/// Returns the least-squares rotation of the ring K_i from rest to current (eq. 6 restricted to
/// rotations). The determinant is always +1. If all points of the ring coincide, returns the
/// identity. For a collinear ring, returns the smallest rotation that maps its line to the new
/// line.
Eigen::Matrix3d fit_rotation(Index i, std::span<const Index> ring,
                             std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> current);

/// Like `fit_rotation` above, from the rest shape stretched by the symmetric matrix `stretch`.
Eigen::Matrix3d fit_rotation(Index i, std::span<const Index> ring,
                             std::span<const Eigen::Vector3d> rest,
                             std::span<const Eigen::Vector3d> current,
                             const Eigen::Matrix3d& stretch);

/// The rotation R of `fit_rotation`, and the factor s for which s R fits the ring best; s = 1 if
/// all points of the ring coincide.
struct RingSimilarity {
  Eigen::Matrix3d R;
  double scale = 1.0;
};
RingSimilarity fit_similarity(Index i, std::span<const Index> ring,
                              std::span<const Eigen::Vector3d> rest,
                              std::span<const Eigen::Vector3d> current);

/// Returns F^-1, where F is the lower Cholesky factor of the positive semidefinite matrix K. If a
/// pivot is almost 0, as for a collinear ring, its row in the result is 0.
Eigen::Matrix3d inverse_cholesky_factor(const Eigen::Matrix3d& K);

/// Returns [v]x, the matrix with [v]x w = v x w.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

}  // namespace lapwing
