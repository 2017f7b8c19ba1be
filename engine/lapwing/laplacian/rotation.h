#pragma once

#include <Eigen/Core>

namespace lapwing {

/// The rotation R that maximizes trace(R' H): for H = sum_k y_k x_k' the one that carries the x_k
/// nearest to the y_k (Horn 1987). Determinant +1 always. For H of rank 1 the smallest rotation
/// that carries the line; the identity for H = 0 or not finite. About 0.2 microseconds.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& H);

/// The rotation by the smallest angle from the unit vector `from` to the unit vector `to`; half a
/// turn about any axis across them where they are opposite.
Eigen::Matrix3d least_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace lapwing
