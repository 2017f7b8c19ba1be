#include "tools/place_tool.h"

#include <gtest/gtest.h>

#include "viewer_state/part_scene.h"

namespace lapwing::viewer::test {
namespace {

using Stage = PlaceTool::Stage;
using Wish = PlaceTool::Wish;

class APlaceTool : public ::testing::Test {
 protected:
  APlaceTool() { tool_.begin(scene_.draft(), scene_.host); }

  ToolAnswer send(const InputEvent& event) { return tool_.handle(event, window_.scene()); }
  Vector3d middle() const { return tool_.draft().frame().center; }
  Vector2d front() const { return window_.pixel_of(Vector3d::UnitZ()); }
  void put_in_front() {
    send(press(front()));
    send(release(front()));
  }

  SphereAndFinger scene_;
  SphereScene window_;
  PlaceTool tool_;
};

TEST_F(APlaceTool, LetsThePartFollowTheCursorOnTheSurface) {
  for (const Vector3d& wanted : {Vector3d(0.3, 0.2, 0.9), Vector3d(-0.4, 0.3, 0.8)}) {
    const Vector3d point = wanted.normalized();
    EXPECT_TRUE(send(move_to(window_.pixel_of(point))).taken);
    EXPECT_LT((middle() - point).norm(), 0.03);
    EXPECT_GT(tool_.draft().frame().normal.dot(point), 0.99);
  }
  EXPECT_EQ(tool_.stage(), Stage::carried);
}

TEST_F(APlaceTool, SetsItDownWhereItIsClicked) {
  EXPECT_FALSE(send(press({2.0, 2.0})).taken) << "beside the surface that turns the view";
  EXPECT_EQ(tool_.stage(), Stage::carried);
  put_in_front();
  EXPECT_EQ(tool_.stage(), Stage::set_down);
  const Vector3d there = middle();
  send(move_to(window_.pixel_of(Vector3d(0.5, 0.1, 0.8))));
  EXPECT_EQ(middle(), there);
}

TEST_F(APlaceTool, SizesAndTurnsWhatItCarriesByTheWheel) {
  send(move_to(front()));
  const double radius = tool_.draft().frame().radius;
  EXPECT_FALSE(send(scrolled(front(), 2.0)).taken) << "that zooms";
  EXPECT_TRUE(send(scrolled(front(), 2.0, kSizes)).taken);
  EXPECT_NEAR(tool_.draft().frame().radius, 1.21 * radius, 1e-9);
  InputEvent turned = scrolled(front(), 3.0);
  turned.modifiers.shift = true;
  const Eigen::Matrix3d before = tool_.draft().placement.linear();
  send(turned);
  const double cosine =
      (before.transpose() * tool_.draft().placement.linear()).trace() / (1.21 * 1.21);
  EXPECT_NEAR(std::acos(0.5 * (cosine - 1.0)) * 180.0 / std::numbers::pi, 15.0, 1e-6);
  // What was chosen goes along.
  send(move_to(window_.pixel_of(Vector3d(0.3, 0.0, 0.95))));
  EXPECT_NEAR(tool_.draft().frame().radius, 1.21 * radius, 1e-9);
}

TEST_F(APlaceTool, MovesWhatIsSetDownByItsGizmo) {
  put_in_front();
  const Vector3d before = middle();
  const Gizmo gizmo = *tool_.gizmo();
  EXPECT_GT(gizmo.axes.col(2).z(), 0.98) << "an arm along the part's normal";
  EXPECT_LT((gizmo.axes.transpose() * gizmo.axes - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  const GizmoLines lines(gizmo, window_.view);
  const auto arm = std::find_if(lines.lines().begin(), lines.lines().end(),
                                [](const GizmoLine& line) { return line.part == GizmoPart::x; });
  ASSERT_NE(arm, lines.lines().end());
  const Vector2d from = 0.5 * (arm->pixels.front() + arm->pixels.back());
  const Vector2d along = (arm->pixels.back() - arm->pixels.front()).normalized();
  EXPECT_TRUE(send(press(from)).taken);
  EXPECT_TRUE(tool_.is_dragging());
  send(move_to(from + 40.0 * along));
  const Vector3d moved = middle() - before;
  EXPECT_GT(moved.dot(gizmo.axes.col(0)), 0.05);
  EXPECT_LT((moved - moved.dot(gizmo.axes.col(0)) * gizmo.axes.col(0)).norm(), 1e-9);
  send(key(kEscape));
  EXPECT_LT((middle() - before).norm(), 1e-12) << "given up";
  EXPECT_FALSE(tool_.is_dragging());
  send(press(from));
  send(move_to(from + 40.0 * along));
  send(release(from + 40.0 * along));
  EXPECT_FALSE(tool_.is_dragging());
  EXPECT_LT((middle() - before - moved).norm(), 1e-12);
}

TEST_F(APlaceTool, TakesItUpAgainAndBringsItBackByEscape) {
  put_in_front();
  const Vector3d before = middle();
  EXPECT_TRUE(send(key('G')).taken);
  EXPECT_EQ(tool_.stage(), Stage::carried);
  send(move_to(window_.pixel_of(Vector3d(0.5, 0.1, 0.8))));
  EXPECT_GT((middle() - before).norm(), 0.3);
  send(key(kEscape));
  EXPECT_EQ(tool_.stage(), Stage::set_down);
  EXPECT_EQ(middle(), before);
  EXPECT_EQ(tool_.take_wish(), Wish::nothing);
}

TEST_F(APlaceTool, SaysWhatEnterAndEscapeAskFor) {
  send(key(kEnter));
  EXPECT_EQ(tool_.stage(), Stage::carried) << "it is nowhere yet";
  send(move_to(front()));
  send(key(kEnter));
  EXPECT_EQ(tool_.stage(), Stage::set_down);
  EXPECT_EQ(tool_.take_wish(), Wish::nothing);
  send(key(kEnter));
  EXPECT_EQ(tool_.take_wish(), Wish::apply);
  EXPECT_EQ(tool_.take_wish(), Wish::nothing) << "once";
  send(key(kEscape));
  EXPECT_EQ(tool_.take_wish(), Wish::give_up);
}

TEST_F(APlaceTool, BringsTheLoopOntoTheSurface) {
  send(move_to(front()));
  const auto loop = transformed(tool_.draft().part->loop, tool_.draft().placement);
  double sum = 0.0;
  for (const Vector3d& point : loop) sum += point.norm() - 1.0;
  EXPECT_NEAR(sum / static_cast<double>(loop.size()), 0.0, 5e-3);
  tool_.snaps = false;
  send(move_to(front() + Vector2d(1.0, 0.0)));
  EXPECT_NEAR(middle().norm(), 1.0, 2e-3) << "then its middle is there";
}

}  // namespace
}  // namespace lapwing::viewer::test
