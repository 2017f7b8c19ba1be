#pragma once

#include <Eigen/Core>

namespace lapwing {

// Eigen's decompositions of 3 x 3 matrices, compiled once: each file that used Eigen's own would
// take seconds longer.

struct SingularValues3 {
  Eigen::Matrix3d U;
  Eigen::Vector3d sigma;  ///< descending, none below 0
  Eigen::Matrix3d V;
};
/// M = U diag(sigma) V'. U and V are orthogonal; either may be a reflection.
SingularValues3 singular_values(const Eigen::Matrix3d& M);

struct Eigenvectors3 {
  Eigen::Vector3d values;   ///< ascending
  Eigen::Matrix3d vectors;  ///< in columns, of length 1
};
/// Of a symmetric matrix, of which the lower triangle is read.
Eigenvectors3 symmetric_eigenvectors(const Eigen::Matrix3d& M);

}  // namespace lapwing
