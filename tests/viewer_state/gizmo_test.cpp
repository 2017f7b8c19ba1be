#include "tools/gizmo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/gizmo_drag.h"
#include "viewer_state/test_view.h"

namespace lapwing::viewer::test {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;

// Pixels of a point that the gizmo's axes reach in `arms`.
Vector2d pixel_at(const Gizmo& gizmo, const Projection& view, const Vector3d& arms) {
  const double arm = kArmPt * view.length_of_pixel(gizmo.center);
  return *view.to_pixel(gizmo.center + gizmo.axes * (arm * arms));
}

class AGizmo : public ::testing::TestWithParam<bool> {
 protected:
  Projection view_ = GetParam() ? perspective({4, 3, 5}, {0.5, 0.2, 0.1})
                                : parallel({4, 3, 5}, {0.5, 0.2, 0.1}, 4.0);
  Gizmo gizmo_{GizmoMode::translate, {0.5, 0.2, 0.1}};

  Vector2d pixel(const Vector3d& arms) const { return pixel_at(gizmo_, view_, arms); }
};
INSTANTIATE_TEST_SUITE_P(Views, AGizmo, ::testing::Bool(),
                         [](const auto& i) { return i.param ? "Perspective" : "Parallel"; });

TEST_P(AGizmo, ArmsPlanesAndTheMiddleAreHitWhereTheyShow) {
  for (const GizmoMode mode : {GizmoMode::translate, GizmoMode::scale}) {
    gizmo_.mode = mode;
    EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0.8, 0, 0})), GizmoPart::x);
    EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0, 0.8, 0})), GizmoPart::y);
    EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0, 0, 0.8})), GizmoPart::z);
    EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0, 0.4, 0.4})), GizmoPart::without_x);
    EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0.4, 0.4, 0})), GizmoPart::without_z);
    EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0, 0, 0})), GizmoPart::view);
    EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0, 0, 0}) + Vector2d(0, 200)), GizmoPart::none);
  }
}

TEST_P(AGizmo, RingsAreHitOnTheHalvesThatFaceTheEye) {
  gizmo_.mode = GizmoMode::rotate;
  const double h = std::sqrt(0.5);
  EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0, h, h})), GizmoPart::x);
  EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({h, 0, h})), GizmoPart::y);
  EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({h, h, 0})), GizmoPart::z);
  EXPECT_NE(hit_gizmo(gizmo_, view_, pixel({0, -h, -h})), GizmoPart::x);
  EXPECT_EQ(hit_gizmo(gizmo_, view_, pixel({0, 0, 0}) + Vector2d(1.2 * kArmPt, 0)),
            GizmoPart::view);
}

TEST_P(AGizmo, DraggedPointStaysUnderTheCursor) {
  const Vector3d from(0.8, 0, 0);
  GizmoDrag drag(gizmo_, GizmoPart::x, view_, pixel(from));
  drag.move_to(pixel({2.0, 0, 0}));
  const Vector3d grabbed = gizmo_.center + kArmPt * view_.length_of_pixel(gizmo_.center) * from;
  const Vector3d moved = drag.motion(drag.amount()) * grabbed;
  EXPECT_LT((*view_.to_pixel(moved) - pixel({2.0, 0, 0})).norm(), 1e-6);
}

TEST_P(AGizmo, AxisAndPlaneHoldTheMotion) {
  GizmoDrag along(gizmo_, GizmoPart::y, view_, pixel({0, 0.8, 0}));
  along.move_to(pixel({1.0, 1.0, 3.0}));
  EXPECT_EQ(along.amount().lengths.cwiseProduct(Vector3d(1, 0, 1)).norm(), 0.0);
  GizmoDrag in_plane(gizmo_, GizmoPart::without_y, view_, pixel({0.4, 0, 0.4}));
  in_plane.move_to(pixel({1.0, 1.0, 3.0}));
  EXPECT_NEAR(in_plane.amount().lengths.y(), 0.0, 1e-9);
}

TEST_P(AGizmo, ViewMovesAcrossTheView) {
  GizmoDrag drag(gizmo_, GizmoPart::view, view_, pixel({0, 0, 0}));
  drag.move_to(pixel({0, 0, 0}) + Vector2d(50, -30));
  const Vector3d moved = drag.motion(drag.amount()) * gizmo_.center;
  EXPECT_LT((*view_.to_pixel(moved) - pixel({0, 0, 0}) - Vector2d(50, -30)).norm(), 1e-6);
  EXPECT_NEAR((moved - gizmo_.center).dot(view_.toward_eye(gizmo_.center)), 0.0, 1e-9);
}

TEST_P(AGizmo, RingTurnsByTheAngleDraggedOverManyTurns) {
  gizmo_.mode = GizmoMode::rotate;
  const auto on_ring = [&](double degrees) {
    const double a = degrees * std::numbers::pi / 180.0;
    return pixel({0, std::cos(a), std::sin(a)});
  };
  GizmoDrag drag(gizmo_, GizmoPart::x, view_, on_ring(10.0));
  for (double degrees = 20.0; degrees <= 810.0; degrees += 10.0) drag.move_to(on_ring(degrees));
  EXPECT_NEAR(drag.amount().degrees, 800.0, 1e-6);
  EXPECT_LT((drag.motion(drag.amount()).linear() -
             AngleAxisd(800.0 * std::numbers::pi / 180.0, Vector3d::UnitX()).toRotationMatrix())
                .norm(),
            1e-9);
}

TEST_P(AGizmo, ViewRingTurnsAsTheCursorGoesRound) {
  gizmo_.mode = GizmoMode::rotate;
  const Vector2d center = pixel({0, 0, 0});
  GizmoDrag drag(gizmo_, GizmoPart::view, view_, center + Vector2d(100, 0));
  drag.move_to(center + Vector2d(0, -100));
  EXPECT_NEAR(drag.amount().degrees, 90.0, 1e-9);
  const Vector3d right = gizmo_.center + 100 * view_.length_of_pixel(gizmo_.center) *
                                             (view_.ray_through(center + Vector2d(1, 0)).direction -
                                              view_.ray_through(center).direction)
                                                 .normalized();
  if (GetParam()) {
    const Vector2d turned = *view_.to_pixel(drag.motion(drag.amount()) * right) - center;
    EXPECT_LT((turned.normalized() - Vector2d(0, -1)).norm(), 0.02);
  }
}

TEST_P(AGizmo, RingSeenFromItsEdgeFollowsTheHand) {
  gizmo_.mode = GizmoMode::rotate;
  const Projection side = perspective({5.5, 0.2, 0.1}, gizmo_.center);
  const Vector2d center = *side.to_pixel(gizmo_.center);
  GizmoDrag drag(gizmo_, GizmoPart::y, side, center);
  drag.move_to(center + Vector2d(0.5 * std::numbers::pi * kArmPt, 0));
  EXPECT_NEAR(std::abs(drag.amount().degrees), 90.0, 1.0);
  const Vector3d front = gizmo_.center + Vector3d(0.5, 0, 0);
  EXPECT_GT(side.to_pixel(drag.motion(drag.amount()) * front)->x(), center.x());
}

TEST_P(AGizmo, ScaleFollowsTheRatioOfDistances) {
  gizmo_.mode = GizmoMode::scale;
  GizmoDrag along(gizmo_, GizmoPart::z, view_, pixel({0, 0, 0.9}));
  along.move_to(pixel({0, 0, 1.8}));
  EXPECT_LT((along.amount().factors - Vector3d(1, 1, 2)).norm(), 1e-9);
  GizmoDrag uniform(gizmo_, GizmoPart::view, view_, pixel({0, 0, 0}) + Vector2d(60, 0));
  uniform.move_to(pixel({0, 0, 0}) + Vector2d(0, 90));
  EXPECT_LT((uniform.amount().factors - Vector3d(1.5, 1.5, 1.5)).norm(), 1e-9);
  uniform.move_to(pixel({0, 0, 0}));
  EXPECT_GT(uniform.amount().factors.minCoeff(), 0.0);
}

TEST_P(AGizmo, EveryMotionButATranslationKeepsTheCenter) {
  for (const GizmoMode mode : {GizmoMode::rotate, GizmoMode::scale}) {
    gizmo_.mode = mode;
    GizmoDrag drag(gizmo_, GizmoPart::y, view_, pixel({0.9, 0.5, 0.3}));
    drag.move_to(pixel({0.2, 0.9, 0.8}));
    const Affine3d motion = drag.motion(drag.amount());
    EXPECT_LT((motion * gizmo_.center - gizmo_.center).norm(), 1e-12);
    EXPECT_GT((motion.linear() - Eigen::Matrix3d::Identity()).norm(), 0.01);
  }
}

TEST_P(AGizmo, SnapsToStepsAndTypedNumbersGoFirst) {
  const SnapSteps steps{.length = 0.25, .degrees = 15.0, .factor = 0.1};
  GizmoDrag drag(gizmo_, GizmoPart::x, view_, pixel({0.8, 0, 0}));
  drag.move_to(pixel({1.9, 0, 0}));
  const double length = drag.amount(steps).lengths.x();
  EXPECT_EQ(std::remainder(length, 0.25), 0.0);
  EXPECT_LE(std::abs(length - drag.amount().lengths.x()), 0.125);
  EXPECT_EQ(drag.amount(steps, -0.7).lengths, Vector3d(-0.7, 0, 0));
}

TEST_P(AGizmo, SnapLengthIsARoundNumber) {
  const double step = snap_length(gizmo_, view_);
  const double digit = step / std::pow(10.0, std::floor(std::log10(step * 1.0001)));
  EXPECT_TRUE(std::abs(digit - 1) < 1e-9 || std::abs(digit - 2) < 1e-9 ||
              std::abs(digit - 5) < 1e-9)
      << step;
}

TEST_P(AGizmo, MoveAfterADragKeepsItsWholeTurns) {
  gizmo_.mode = GizmoMode::rotate;
  GizmoDrag drag(gizmo_, GizmoPart::z, view_, pixel({1, 0, 0}));
  SimilarityMove before;
  before.rotate = {Vector3d::UnitZ(), 300.0};
  const Vector3d centroid = gizmo_.center;
  const Move after = drag.move_after(before, centroid, drag.amount({}, 200.0));
  EXPECT_NEAR(turn_of(after).degrees, 500.0, 1e-6);
  const Move back = drag.move_after(after, centroid, drag.amount({}, -500.0));
  EXPECT_NEAR(turn_of(back).degrees, 0.0, 1e-6);
}

TEST_P(AGizmo, MoveAfterADragIsOneMotionAfterTheOther) {
  gizmo_.mode = GizmoMode::rotate;
  SimilarityMove before;
  before.translate = {0.3, 0.1, -0.2};
  before.rotate = {Vector3d::UnitX(), 250.0};
  const Vector3d centroid(0.2, 0.1, 0.4);
  GizmoDrag drag(gizmo_, GizmoPart::y, view_, pixel({1, 0, 0}));
  const GizmoAmount amount = drag.amount({}, 77.0);
  const Affine3d expected = drag.motion(amount) * to_affine(before, centroid);
  EXPECT_LT(
      (to_affine(drag.move_after(before, centroid, amount), centroid).matrix() - expected.matrix())
          .norm(),
      1e-9);
}

}  // namespace
}  // namespace lapwing::viewer::test
