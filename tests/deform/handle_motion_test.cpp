#include "lapwing/deform/handle_motion.h"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

using Eigen::Vector3d;

const Positions kPoints{{1, 2, 3}, {4, -1, 0}, {0, 0, 7}};
const std::vector<Index> kHandle{0, 1, 2};

TEST(HandleMotion, IdentityHasParametersExactlyZero) {
  const HandleFrame frame = handle_frame(kHandle, kPoints);
  std::vector<double> q(kMotionParameters, 1.0);
  motion_parameters(frame, Eigen::Affine3d::Identity(), q);
  for (const double parameter : q) EXPECT_EQ(parameter, 0.0);
}

TEST(HandleMotion, ParametersReproduceAnyAffineMotion) {
  const HandleFrame frame = handle_frame(kHandle, kPoints);
  Eigen::Affine3d motion = Eigen::Translation3d(3, 4, 5) *
                           Eigen::AngleAxisd(2.0, Vector3d(1, 1, 0).normalized()) *
                           Eigen::Scaling(1.0, 2.0, 0.5);
  std::vector<double> q(kMotionParameters);
  motion_parameters(frame, motion, q);
  for (const Vector3d& p : kPoints) {
    Vector3d u = Vector3d::Zero();
    u += handle_displacement(frame, q, p);
    EXPECT_LT((p + u - motion * p).norm(), 1e-13);
  }
}

TEST(HandleMotion, SingleVertexHandleHasAUsableFrame) {
  const HandleFrame frame = handle_frame(std::vector<Index>{1}, kPoints);
  EXPECT_EQ(frame.centroid, kPoints[1]);
  EXPECT_GT(frame.radius, 0.0);
}

}  // namespace
}  // namespace lapwing
