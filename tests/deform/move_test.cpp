#include "lapwing/deform/move.h"

#include <cstring>
#include <numbers>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

const Vector3d kCentroid(1.0, 2.0, 3.0);

TEST(Move, ByNothingIsTheIdentityBitForBit) {
  const Eigen::Matrix4d identity = Eigen::Matrix4d::Identity();
  const Move moves[] = {SimilarityMove{}, MatrixMove{},
                        SimilarityMove{.rotate = {Vector3d(-1, -2, 3), 0.0},
                                       .scale = Vector3d::Ones(),
                                       .pivot = Vector3d(0.1, -7.3, 1e6)}};
  for (const Move& move : moves) {
    const Affine3d map = to_affine(move, kCentroid);
    EXPECT_EQ(std::memcmp(map.matrix().data(), identity.data(), sizeof(double) * 16), 0);
  }
}

TEST(Move, TurnsAndScalesAboutTheCentroidUnlessAPivotIsGiven) {
  SimilarityMove move{.rotate = {Vector3d(1, 1, 0), 75.0}, .scale = Vector3d::Constant(2.5)};
  EXPECT_LT((to_affine(move, kCentroid) * kCentroid - kCentroid).norm(), 1e-14);
  move.pivot = Vector3d(-4, 0, 9);
  EXPECT_LT((to_affine(move, kCentroid) * *move.pivot - *move.pivot).norm(), 1e-14);
}

TEST(Move, IsPivotPlusScaledTurnPlusTranslation) {
  const Vector3d pivot(0.5, -1.0, 2.0);
  const Vector3d translate(3.0, 1.0, -2.0);
  const Vector3d axis(1.0, -2.0, 0.5);
  const Affine3d map = to_affine(
      SimilarityMove{translate, {axis, 40.0}, Vector3d::Constant(0.75), pivot}, kCentroid);
  const Affine3d expected = Eigen::Translation3d(translate) * Eigen::Translation3d(pivot) *
                            Eigen::Scaling(0.75) *
                            Eigen::AngleAxisd(40.0 * std::numbers::pi / 180.0, axis.normalized()) *
                            Eigen::Translation3d(-pivot);
  EXPECT_LT((map.matrix() - expected.matrix()).norm(), 1e-14);
}

TEST(Move, MatrixIsTakenAsItIs) {
  MatrixMove move;
  move.matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12;
  EXPECT_EQ(to_affine(move, kCentroid) * Vector3d(1, 0, -1), Vector3d(2, 6, 10));
}

// ---- Parts of moves.

MatrixMove matrix_of(const Affine3d& map) {
  return {map.matrix().topRows<3>()};
}

// One of each kind: turned, stretched, moved.
std::vector<Move> moves_to_divide() {
  const SimilarityMove similarity{Vector3d(3, 1, -2),
                                  {Vector3d(1, -2, 0.5), 260.0},
                                  Vector3d::Constant(0.75),
                                  Vector3d(0.5, -1, 2)};
  const Affine3d map = Eigen::Translation3d(1, 2, -1) *
                       Eigen::AngleAxisd(2.0, Vector3d(1, 1, 0).normalized()) *
                       Eigen::Scaling(1.5, 0.4, 1.0);
  return {similarity, matrix_of(map)};
}

TEST(MovePart, EndsAreTheIdentityAndTheMove) {
  for (const Move& move : moves_to_divide()) {
    EXPECT_LT((to_affine(move, kCentroid, 0.0).matrix() - Eigen::Matrix4d::Identity()).norm(),
              1e-14);
    EXPECT_EQ(to_affine(move, kCentroid, 1.0).matrix(), to_affine(move, kCentroid).matrix());
  }
}

TEST(MovePart, OfNothingIsTheIdentityBitForBit) {
  const Eigen::Matrix4d identity = Eigen::Matrix4d::Identity();
  const Move still = SimilarityMove{.rotate = {Vector3d(-1, -2, 3), 0.0}};
  const Affine3d part = to_affine(still, kCentroid, 0.3);
  EXPECT_EQ(std::memcmp(part.matrix().data(), identity.data(), sizeof(double) * 16), 0);
}

TEST(MovePart, TurnsByItsShareOfTheAngleAboutTheSamePivot) {
  const Vector3d pivot(4, 5, 6);
  const Move move = SimilarityMove{.rotate = {Vector3d::UnitZ(), 260.0}, .pivot = pivot};
  const Move half = SimilarityMove{.rotate = {Vector3d::UnitZ(), 130.0}, .pivot = pivot};
  EXPECT_LT((to_affine(move, kCentroid, 0.5).matrix() - to_affine(half, kCentroid).matrix()).norm(),
            1e-14);
}

TEST(Move, ScalesAlongTheAxesOfTheMeshBeforeItTurns) {
  const Eigen::AngleAxisd turn(0.5 * std::numbers::pi, Vector3d::UnitZ());
  const Move move = SimilarityMove{.rotate = {Vector3d::UnitZ(), 90.0}, .scale = Vector3d(2, 3, 4)};
  const Eigen::Matrix3d expected = turn.toRotationMatrix() * Vector3d(2, 3, 4).asDiagonal();
  EXPECT_LT((to_affine(move, kCentroid).linear() - expected).norm(), 1e-14);
  const Move still = SimilarityMove{.scale = Vector3d(4, 1, 9)};
  EXPECT_LT(
      (to_affine(still, kCentroid, 0.5).linear() - Eigen::Matrix3d(Vector3d(2, 1, 3).asDiagonal()))
          .norm(),
      1e-14);
}

TEST(MovePart, EqualPartsOfATurnAreEqualMotions) {
  const Move move =
      SimilarityMove{.rotate = {Vector3d(1, 2, 3), 300.0}, .scale = Vector3d::Constant(8.0)};
  const Affine3d third = to_affine(move, kCentroid, 1.0 / 3.0);
  EXPECT_LT((to_affine(move, kCentroid, 2.0 / 3.0).matrix() - (third * third).matrix()).norm(),
            1e-12);
  EXPECT_LT((to_affine(move, kCentroid).matrix() - (third * third * third).matrix()).norm(), 1e-12);
}

TEST(MovePart, OfAMatrixTurnsAndStretchesWhileTheCentroidGoesStraight) {
  const Eigen::AngleAxisd turn(2.0, Vector3d(1, 1, 0).normalized());
  const Affine3d whole = Eigen::Translation3d(1, 2, -1) * turn * Eigen::Scaling(1.5, 0.4, 1.0);
  const Affine3d half = to_affine(matrix_of(whole), kCentroid, 0.5);
  const Eigen::Matrix3d expected = Eigen::AngleAxisd(1.0, turn.axis()).toRotationMatrix() *
                                   Vector3d(1.25, 0.7, 1.0).asDiagonal();
  EXPECT_LT((half.linear() - expected).norm(), 1e-12);
  EXPECT_LT((half * kCentroid - 0.5 * (kCentroid + whole * kCentroid)).norm(), 1e-12);
}

TEST(MovePart, OfAFlatteningMatrixCanBeUndone) {
  const Move flat = matrix_of(Affine3d(Eigen::Scaling(1.0, 0.0, 1.0)));
  const Affine3d part = to_affine(flat, kCentroid, 0.75);
  EXPECT_NEAR(part.linear().determinant(), 0.25, 1e-12);
}

TEST(MovePart, OfAMirrorIsRefused) {
  const Move mirror = matrix_of(Affine3d(Eigen::Scaling(1.0, -1.0, 1.0)));
  EXPECT_TRUE(mirrors(mirror));
  EXPECT_EQ(to_affine(mirror, kCentroid, 1.0).matrix(), to_affine(mirror, kCentroid).matrix());
  EXPECT_NE(error_message<InputError>([&] { to_affine(mirror, kCentroid, 0.5); }).find("mirrors"),
            std::string::npos);
  for (const Move& move : moves_to_divide()) EXPECT_FALSE(mirrors(move));
}

TEST(MoveTurn, IsAsWritten) {
  const AxisRotation turn = turn_of(SimilarityMove{.rotate = {Vector3d(0, 0, 7), -260.0}});
  EXPECT_EQ(turn.degrees, 260.0);
  EXPECT_EQ(turn.axis, Vector3d(0, 0, -1));
  EXPECT_EQ(turn_of(SimilarityMove{.translate = Vector3d(1, 2, 3)}).degrees, 0.0);
}

TEST(MoveTurn, OfAMatrixIsThatOfItsRotation) {
  const Affine3d map =
      Eigen::AngleAxisd(2.0, Vector3d::UnitX()) * Affine3d(Eigen::Scaling(1.5, 0.4, 1.0));
  const AxisRotation turn = turn_of(matrix_of(map));
  EXPECT_NEAR(turn.degrees, 2.0 * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_LT((turn.axis - Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_EQ(turn_of(matrix_of(Affine3d(Eigen::Scaling(1.0, -1.0, 1.0)))).degrees, 0.0);
}

}  // namespace
}  // namespace lapwing
