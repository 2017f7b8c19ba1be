#pragma once

#include <Eigen/Core>

namespace lapwing {

// Eigen's decompositions of 3 x 3 matrices, compiled only once. Files that include Eigen's headers
// for them take seconds longer to compile.

struct SingularValues3 {
  Eigen::Matrix3d U;
  Eigen::Vector3d sigma;  ///< descending, at least 0
  Eigen::Matrix3d V;
};
/// Returns M = U diag(sigma) V'. U and V are orthogonal; either may be a reflection.
SingularValues3 singular_values(const Eigen::Matrix3d& M);

struct Eigenvectors3 {
  Eigen::Vector3d values;   ///< ascending
  Eigen::Matrix3d vectors;  ///< unit vectors, in columns
};
/// Decomposes a symmetric matrix. Reads only its lower triangle.
Eigenvectors3 symmetric_eigenvectors(const Eigen::Matrix3d& M);

}  // namespace lapwing
