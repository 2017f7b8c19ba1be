#include "lapwing/deform/turn_tracker.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

const Vector3d kTilted = Vector3d(1, -2, 3).normalized();

Affine3d turn(double degrees, const Vector3d& axis) {
  return Eigen::Translation3d(4, 5, 6) *
         Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized()) *
         Eigen::Translation3d(-1, 2, -3);
}

// Follows a drag about `axis` from one angle to another, the first included.
void drag(TurnTracker& tracker, const Vector3d& axis, double from, double to, double step) {
  const int count = static_cast<int>(std::round(std::abs(to - from) / step));
  for (int k = 0; k <= count; ++k) tracker.follow(turn(from + (to - from) * k / count, axis));
}

void expect_turn(const TurnTracker& tracker, double degrees, const Vector3d& axis) {
  EXPECT_NEAR(tracker.degrees(), degrees, 1e-9);
  EXPECT_LT((tracker.axis() - axis).norm(), 1e-9);
}

TEST(TurnTracker, StillHandleHasNoTurn) {
  TurnTracker tracker;
  EXPECT_EQ(tracker.degrees(), 0.0);
  for (int k = 0; k < 3; ++k) tracker.follow(Affine3d::Identity());
  EXPECT_EQ(tracker.degrees(), 0.0);
  EXPECT_EQ(tracker.axis(), Vector3d(Vector3d::Zero()));
  tracker.follow(Affine3d(Eigen::Translation3d(1, 2, 3)));
  EXPECT_EQ(tracker.degrees(), 0.0);
}

TEST(TurnTracker, GoesOnPastHalfAndWholeTurns) {
  for (const double step : {1.0, 30.0, 179.0}) {
    for (const Vector3d& axis : {Vector3d(Vector3d::UnitZ()), kTilted}) {
      TurnTracker tracker;
      drag(tracker, axis, 0.0, 4.0 * step, step);
      expect_turn(tracker, 4.0 * step, axis);
      drag(tracker, axis, 4.0 * step, 60.0 * step, step);
      expect_turn(tracker, 60.0 * step, axis);
    }
  }
}

TEST(TurnTracker, GoesOnFromTheTurnItIsGiven) {
  for (const double begun : {200.0, 350.0, 500.0}) {
    TurnTracker tracker(Eigen::AngleAxisd(begun * std::numbers::pi / 180.0, kTilted));
    expect_turn(tracker, begun, kTilted);
    tracker.follow(turn(begun + 40.0, kTilted));
    expect_turn(tracker, begun + 40.0, kTilted);
    const Eigen::AngleAxisd all = tracker.turn();
    EXPECT_NEAR(all.angle() * 180.0 / std::numbers::pi, begun + 40.0, 1e-9);
    EXPECT_LT((all.axis() - kTilted).norm(), 1e-9);
  }
}

TEST(TurnTracker, ComesBackToNothingAndOnToTheOtherSide) {
  TurnTracker tracker;
  drag(tracker, kTilted, 0.0, 400.0, 10.0);
  drag(tracker, kTilted, 400.0, 0.0, 10.0);
  EXPECT_NEAR(tracker.degrees(), 0.0, 1e-9);
  drag(tracker, kTilted, 0.0, -250.0, 10.0);
  expect_turn(tracker, 250.0, -kTilted);
}

TEST(TurnTracker, HandThatIsNotSteadyDoesNotLoseAWholeTurn) {
  TurnTracker tracker;
  for (int degrees = 0; degrees <= 720; degrees += 5) {
    const Vector3d off_axis(degrees % 2 == 0 ? 8.0 : -8.0, 3.0, 0.0);
    tracker.follow(turn(off_axis.norm(), off_axis) * turn(degrees, Vector3d::UnitZ()));
  }
  EXPECT_NEAR(tracker.degrees(), 720.0, 10.0);
  EXPECT_GT(tracker.axis().z(), 0.95);
}

TEST(TurnTracker, FollowsAnAxisThatWanders) {
  TurnTracker tracker;
  drag(tracker, Vector3d::UnitZ(), 0.0, 220.0, 10.0);
  for (int k = 0; k <= 90; k += 5) {
    tracker.follow(turn(k, Vector3d::UnitX()) * turn(220.0, Vector3d::UnitZ()) *
                   turn(-k, Vector3d::UnitX()));
  }
  expect_turn(tracker, 220.0, -Vector3d::UnitY());
}

TEST(TurnTracker, LargeStepIsTheShortWayRound) {
  TurnTracker tracker;
  tracker.follow(turn(200.0, kTilted));
  expect_turn(tracker, 160.0, -kTilted);
}

TEST(TurnTracker, StretchIsNoTurnAndAMirrorKeepsTheLastOne) {
  TurnTracker tracker;
  const Affine3d stretch(Eigen::Scaling(0.5, 2.0, 3.0));
  drag(tracker, kTilted, 0.0, 200.0, 20.0);
  tracker.follow(turn(210.0, kTilted) * stretch);
  expect_turn(tracker, 210.0, kTilted);
  for (const Affine3d& motion :
       {Affine3d(Eigen::Scaling(-1.0, 1.0, 1.0)), Affine3d(Eigen::Scaling(1.0, 0.0, 1.0)),
        Affine3d(Eigen::Scaling(std::nan(""), 1.0, 1.0))}) {
    tracker.follow(motion);
    expect_turn(tracker, 210.0, kTilted);
  }
}

}  // namespace
}  // namespace lapwing
