#include "lapwing/laplacian/rotation.h"

#include <cmath>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d by_svd(const Matrix3d& H) {
  const Eigen::JacobiSVD<Matrix3d> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d U = svd.matrixU();
  if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(2) = -U.col(2);
  return U * svd.matrixV().transpose();
}

void expect_rotation(const Matrix3d& R) {
  EXPECT_LT((R.transpose() * R - Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_GT(R.determinant(), 0.0);
}

TEST(NearestRotation, OfARotationIsItself) {
  std::mt19937 random(1);
  std::normal_distribution<double> number;
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Quaterniond q(number(random), number(random), number(random), number(random));
    const Matrix3d R = q.normalized().toRotationMatrix();
    EXPECT_LT((nearest_rotation(3.7 * R) - R).norm(), 1e-12);
  }
}

TEST(NearestRotation, IsThatOfTheSingularValueDecomposition) {
  std::mt19937 random(2);
  std::normal_distribution<double> number;
  for (int k = 0; k < 1000; ++k) {
    Matrix3d H;
    for (double& h : H.reshaped()) h = number(random);
    const Matrix3d R = nearest_rotation(H);
    expect_rotation(R);
    const Eigen::JacobiSVD<Matrix3d> svd(H);
    const double sign = H.determinant() < 0.0 ? -1.0 : 1.0;
    const double gap = svd.singularValues()[1] + sign * svd.singularValues()[2];
    if (gap > 1e-2) {
      EXPECT_LT((R - by_svd(H)).norm(), 1e-9);
    }
    EXPECT_NEAR((R.transpose() * H).trace(),
                svd.singularValues()[0] + svd.singularValues()[1] + sign * svd.singularValues()[2],
                1e-10 * H.norm());
  }
}

TEST(NearestRotation, OfAFlatRingTurnsItsPlane) {
  const Matrix3d R = Eigen::AngleAxisd(2.9, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Matrix3d flat = Vector3d(1, 0.7, 0).asDiagonal();
  EXPECT_LT((nearest_rotation(R * flat) - R).norm(), 1e-12);
}

TEST(NearestRotation, OfALineIsTheSmallestThatCarriesIt) {
  const Vector3d from = Vector3d(1, 2, 3).normalized();
  const Vector3d to = Vector3d(-1, 0.5, 0.2).normalized();
  const Matrix3d R = nearest_rotation(to * from.transpose());
  expect_rotation(R);
  EXPECT_LT((R * from - to).norm(), 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(R).angle(), std::acos(from.dot(to)), 1e-7);
}

TEST(NearestRotation, OfNothingIsTheIdentity) {
  EXPECT_EQ(nearest_rotation(Matrix3d::Zero()), Matrix3d::Identity());
  EXPECT_EQ(nearest_rotation(Matrix3d::Constant(std::nan(""))), Matrix3d::Identity());
}

TEST(PolarStretch, IsTheSymmetricFactorWithoutTheRotation) {
  const Eigen::AngleAxisd tilt(0.4, Eigen::Vector3d(3.0, 1.0, 2.0).normalized());
  const Eigen::Matrix3d P = tilt * Eigen::Vector3d(2.0, 0.5, 1.0).asDiagonal() * tilt.inverse();
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(2.2, Eigen::Vector3d(1.0, 0.0, 1.0).normalized()).matrix();
  EXPECT_LT((polar_stretch(R * P) - P).norm(), 1e-12);
  EXPECT_LT((polar_stretch(-P) - P).norm(), 1e-12) << "of a mirror image";
  EXPECT_GE(polar_stretch(Eigen::Matrix3d::Zero()).diagonal().minCoeff(), kLeastStretch);
}

}  // namespace
}  // namespace lapwing
