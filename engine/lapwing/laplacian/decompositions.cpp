#include "lapwing/laplacian/decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace lapwing {

using Eigen::Matrix3d;

SingularValues3 singular_values(const Matrix3d& M) {
  const Eigen::JacobiSVD<Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigenvectors3 symmetric_eigenvectors(const Matrix3d& M) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(M);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace lapwing
