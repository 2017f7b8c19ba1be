#include "lapwing/transplant/place_at.h"

#include <limits>

#include <gmock/gmock.h>

#include "lapwing/base/errors.h"
#include "lapwing/transplant/loop_curve.h"
#include "support/error_message.h"
#include "transplant/loops.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::circle_points;
using test::difference;
using test::moved;
using test::similarity;

const Affine3d kIdentity = Affine3d::Identity();

TEST(PlaceAt, LoopComesToThePointAndStandsAlongTheNormal) {
  const auto part = moved(similarity(70.0, {1, 2, 0}, 0.5, {3, 1, 4}), circle_points(20));
  const SurfacePlace place{{1, 2, 3}, {0, -2, 1}};
  const Affine3d placed = place_at(kIdentity, part, place, "place");
  const LoopFrame frame = loop_frame(LoopCurve(moved(placed, part), "loop"));
  EXPECT_LT((frame.center - place.point).norm(), 1e-12);
  EXPECT_LT((frame.normal - place.normal.normalized()).norm(), 1e-12);
  EXPECT_NEAR(placed.linear().determinant(), 1.0, 1e-12);
}

TEST(PlaceAt, PartThatStandsThereStays) {
  const Affine3d placement = similarity(33.0, {0, 0, 1}, 2.0, {1, 1, 0});
  const Affine3d placed = place_at(placement, circle_points(20), {{1, 1, 0}, {0, 0, 5}}, "place");
  EXPECT_LT(difference(placed, placement), 1e-12);
}

TEST(PlaceAt, TurnsNoMoreThanTheNormalsDo) {
  const SurfacePlace place{{0, 0, 0}, {0, std::sin(0.3), std::cos(0.3)}};
  const Affine3d placed = place_at(kIdentity, circle_points(20), place, "place");
  const Eigen::AngleAxisd turn(placed.linear());
  EXPECT_NEAR(turn.angle(), 0.3, 1e-12);
  EXPECT_NEAR(std::abs(turn.axis().x()), 1.0, 1e-12);
}

TEST(PlaceAt, StandsOnItsHeadWhereTheNormalPointsDown) {
  const Affine3d placed = place_at(kIdentity, circle_points(20), {{0, 0, 0}, {0, 0, -1}}, "place");
  EXPECT_NEAR(placed.linear().determinant(), 1.0, 1e-12);
  EXPECT_LT((placed.linear() * Vector3d::UnitZ() + Vector3d::UnitZ()).norm(), 1e-12);
}

TEST(PlaceAt, TurnAndScaleComeOnTop) {
  const Affine3d placement = similarity(10.0, {0, 0, 1}, 2.0, {0, 0, 0});
  const Affine3d placed =
      place_at(placement, circle_points(20), {{0, 0, 1}, {0, 0, 1}, 25.0, 3.0}, "place");
  EXPECT_LT(difference(placed, similarity(35.0, {0, 0, 1}, 6.0, {0, 0, 1})), 1e-12);
}

TEST(PlaceAt, WhatIsNoPlaceIsRefused) {
  const auto refused = [](const SurfacePlace& place) {
    return error_message<InputError>(
        [&] { place_at(kIdentity, circle_points(20), place, "here"); });
  };
  EXPECT_THAT(refused({{0, 0, 0}, {0, 0, 0}}), testing::HasSubstr("here: "));
  EXPECT_NE(refused({{std::numeric_limits<double>::quiet_NaN(), 0, 0}, {0, 0, 1}}), "");
  EXPECT_THAT(refused({{0, 0, 0}, {0, 0, 1}, 0.0, -1.0}), testing::HasSubstr("above 0"));
}

}  // namespace
}  // namespace lapwing
