#include "lapwing/recipe/move.h"

#include <cstring>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

const Vector3d kCentroid(1.0, 2.0, 3.0);

TEST(Move, ByNothingIsTheIdentityBitForBit) {
  const Eigen::Matrix4d identity = Eigen::Matrix4d::Identity();
  const Move moves[] = {
      SimilarityMove{}, MatrixMove{},
      SimilarityMove{
          .rotate = {Vector3d(-1, -2, 3), 0.0}, .scale = 1.0, .pivot = Vector3d(0.1, -7.3, 1e6)}};
  for (const Move& move : moves) {
    const Affine3d map = to_affine(move, kCentroid);
    EXPECT_EQ(std::memcmp(map.matrix().data(), identity.data(), sizeof(double) * 16), 0);
  }
}

TEST(Move, TurnsAndScalesAboutTheCentroidUnlessAPivotIsGiven) {
  SimilarityMove move{.rotate = {Vector3d(1, 1, 0), 75.0}, .scale = 2.5};
  EXPECT_LT((to_affine(move, kCentroid) * kCentroid - kCentroid).norm(), 1e-14);
  move.pivot = Vector3d(-4, 0, 9);
  EXPECT_LT((to_affine(move, kCentroid) * *move.pivot - *move.pivot).norm(), 1e-14);
}

TEST(Move, IsPivotPlusScaledTurnPlusTranslation) {
  const Vector3d pivot(0.5, -1.0, 2.0);
  const Vector3d translate(3.0, 1.0, -2.0);
  const Vector3d axis(1.0, -2.0, 0.5);
  const Affine3d map = to_affine(SimilarityMove{translate, {axis, 40.0}, 0.75, pivot}, kCentroid);
  const Affine3d expected = Eigen::Translation3d(translate) * Eigen::Translation3d(pivot) *
                            Eigen::Scaling(0.75) *
                            Eigen::AngleAxisd(40.0 * std::numbers::pi / 180.0, axis.normalized()) *
                            Eigen::Translation3d(-pivot);
  EXPECT_LT((map.matrix() - expected.matrix()).norm(), 1e-14);
}

TEST(Move, TurnsRightHanded) {
  const SimilarityMove quarter{.rotate = {Vector3d(0, 0, 7), 90.0}, .pivot = Vector3d::Zero()};
  EXPECT_LT((to_affine(quarter, kCentroid) * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-15);
}

TEST(Move, MatrixIsTakenAsItIs) {
  MatrixMove move;
  move.matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12;
  EXPECT_EQ(to_affine(move, kCentroid) * Vector3d(1, 0, -1), Vector3d(2, 6, 10));
}

}  // namespace
}  // namespace lapwing
