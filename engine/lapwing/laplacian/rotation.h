#pragma once

#include <Eigen/Core>

namespace lapwing {

/// The rotation R that maximizes trace(R' H): for H = sum_k y_k x_k' the one that carries the x_k
/// nearest to the y_k (Horn 1987). Determinant +1 always. For H of rank 1 the smallest rotation
/// that carries the line; the identity for H = 0 or not finite. About 0.2 microseconds.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& H);

/// The rotation by the least angle that takes `from`, of length 1, to `to`, of length 1. For
/// opposite ones about an axis that depends on `from` alone.
Eigen::Matrix3d least_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The stretch P of A = R P, R a rotation: the root of A'A. No direction becomes shorter than
/// kLeastStretch, so that the rotation of a flattened shape stays defined.
Eigen::Matrix3d polar_stretch(const Eigen::Matrix3d& A);
inline constexpr double kLeastStretch = 1e-3;

}  // namespace lapwing
