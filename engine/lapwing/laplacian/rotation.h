#pragma once

#include <Eigen/Core>

namespace lapwing {

/// Returns the rotation R that maximizes trace(R' H) (Horn 1987). For H = sum_k y_k x_k', it
/// carries the x_k nearest to the y_k. The determinant is always +1. If H has rank 1, R is the
/// smallest rotation that carries the line. If H is 0 or not finite, R is the identity. About 0.2
/// microseconds.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& H);

/// Returns the rotation by the least angle between the unit vectors `from` and `to`. If they are
/// opposite, the axis depends on `from` alone.
Eigen::Matrix3d least_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// Returns the stretch P of the polar decomposition A = R P: the root of A'A. No direction becomes
/// shorter than kLeastStretch, so that the rotation of a flattened shape stays defined.
Eigen::Matrix3d polar_stretch(const Eigen::Matrix3d& A);
inline constexpr double kLeastStretch = 1e-3;

}  // namespace lapwing
