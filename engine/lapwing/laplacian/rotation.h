#pragma once

#include <Eigen/Core>

namespace lapwing {

/// Returns the rotation R that maximizes trace(R' H) (Horn 1987). For H = sum_k y_k x_k', R is the
/// rotation that maps the x_k closest to the y_k. The determinant is always +1. If H has rank 1, R
/// is the smallest rotation that maps the line of the x_k to that of the y_k. If H is 0 or not
/// finite, R is the identity. Takes about 0.2 microseconds.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& H);

/// Returns the rotation with the smallest angle that maps the unit vector `from` to `to`. If the
/// vectors are opposite, the axis depends only on `from`.
Eigen::Matrix3d least_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Returns the stretch P of the polar decomposition A = R P, that is, the square root of A'A. The
/// eigenvalues of P are at least kLeastStretch, so that a flattened shape still has a rotation.
Eigen::Matrix3d polar_stretch(const Eigen::Matrix3d& A);
inline constexpr double kLeastStretch = 1e-3;

}  // namespace lapwing
