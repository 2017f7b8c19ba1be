// What is for the hand and the eye is as large on a dense display as on another: as many times as
// large in pixels.
#include <gtest/gtest.h>

#include "tools/disk_tool.h"
#include "tools/gizmo_drag.h"
#include "tools/loop_tool.h"
#include "tools/paint_tool.h"
#include "tools/pin_tool.h"
#include "tools/ruler_tool.h"
#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {
namespace {

constexpr double kDensity = 2.0;

Projection view_at(double pixels_per_point) {
  return perspective({4, 3, 5}, {0.5, 0.2, 0.1}, Vector3d::UnitY(), pixels_per_point);
}

class AGizmoOnADenseDisplay : public ::testing::TestWithParam<GizmoMode> {
 protected:
  Gizmo gizmo_{GetParam(), {0.5, 0.2, 0.1}};
  Projection plain_ = view_at(1.0);
  Projection dense_ = view_at(kDensity);
};
INSTANTIATE_TEST_SUITE_P(Modes, AGizmoOnADenseDisplay,
                         ::testing::Values(GizmoMode::translate, GizmoMode::rotate,
                                           GizmoMode::scale),
                         [](const auto& i) {
                           return i.param == GizmoMode::translate ? "Translate"
                                  : i.param == GizmoMode::rotate  ? "Rotate"
                                                                  : "Scale";
                         });

TEST_P(AGizmoOnADenseDisplay, HasTheSameLinesInMorePixels) {
  const GizmoLines plain(gizmo_, plain_);
  const GizmoLines dense(gizmo_, dense_);
  ASSERT_EQ(plain.lines().size(), dense.lines().size());
  for (std::size_t k = 0; k < plain.lines().size(); ++k) {
    ASSERT_EQ(plain.lines()[k].pixels.size(), dense.lines()[k].pixels.size());
    for (std::size_t p = 0; p < plain.lines()[k].pixels.size(); ++p) {
      EXPECT_LT((kDensity * plain.lines()[k].pixels[p] - dense.lines()[k].pixels[p]).norm(), 1e-3);
    }
  }
}

TEST_P(AGizmoOnADenseDisplay, IsHitAtTheSamePlaces) {
  const Vector2d center = *plain_.to_pixel(gizmo_.center);
  int hits = 0;
  for (double x = -130.0; x <= 130.0; x += 3.1) {
    for (double y = -130.0; y <= 130.0; y += 3.1) {
      const Vector2d place = center + Vector2d(x, y);
      const GizmoPart part = hit_gizmo(gizmo_, plain_, place);
      EXPECT_EQ(part, hit_gizmo(gizmo_, dense_, kDensity * place)) << place.transpose();
      if (part != GizmoPart::none) ++hits;
    }
  }
  EXPECT_GT(hits, 300);
}

TEST_P(AGizmoOnADenseDisplay, IsDraggedByTheSameWayOfTheHand) {
  const Vector2d center = *plain_.to_pixel(gizmo_.center);
  for (const GizmoPart part : {GizmoPart::x, GizmoPart::y, GizmoPart::without_z, GizmoPart::view}) {
    const Vector2d from = center + Vector2d(12.0, 5.0);
    const Vector2d to = center + Vector2d(70.0, -30.0);
    GizmoDrag plain(gizmo_, part, plain_, from);
    plain.move_to(to);
    GizmoDrag dense(gizmo_, part, dense_, kDensity * from);
    dense.move_to(kDensity * to);
    EXPECT_LT(
        (plain.motion(plain.amount()).matrix() - dense.motion(dense.amount()).matrix()).norm(),
        1e-9);
    EXPECT_NE(plain.amount(), GizmoAmount{});
  }
  EXPECT_DOUBLE_EQ(snap_length(gizmo_, plain_), snap_length(gizmo_, dense_));
}

TEST(ADenseDisplay, HasRingsSeenFromTheirEdgeDraggedByTheSameWay) {
  const Gizmo gizmo{GizmoMode::rotate, {0.5, 0.2, 0.1}};
  double degrees[2];
  for (const double density : {1.0, kDensity}) {
    const Projection side = perspective({5.5, 0.2, 0.1}, gizmo.center, Vector3d::UnitY(), density);
    const Vector2d center = *side.to_pixel(gizmo.center);
    GizmoDrag drag(gizmo, GizmoPart::y, side, center);
    drag.move_to(center + density * Vector2d(40.0, 0.0));
    degrees[density == 1.0 ? 0 : 1] = drag.amount().degrees;
  }
  EXPECT_NEAR(degrees[0], degrees[1], 1e-9);
  EXPECT_GT(std::abs(degrees[0]), 10.0);
}

// Tools over the sphere, by lengths in points.
class AHand : public ::testing::TestWithParam<double> {
 protected:
  AHand() {
    sphere_.view = perspective({0.3, 0.4, 6}, {0, 0, 0}, Vector3d::UnitY(), GetParam());
    front_ = sphere_.vertex_near({0, 0, 1});
    side_ = sphere_.vertex_near({0.5, 0, 0.8});
  }
  // So many points to the right of where the vertex shows.
  Vector2d beside(Index vertex, double points) const {
    return sphere_.pixel_of(vertex) + Vector2d(GetParam() * points, 0.0);
  }
  ToolAnswer send(SceneTool& tool, const InputEvent& event) {
    return tool.handle(event, sphere_.scene());
  }

  SphereScene sphere_;
  Index front_ = kNoIndex;
  Index side_ = kNoIndex;
};
INSTANTIATE_TEST_SUITE_P(Densities, AHand, ::testing::Values(1.0, kDensity),
                         [](const auto& i) { return i.param == 1.0 ? "Plain" : "Dense"; });

TEST_P(AHand, TakesAPinFromAFewPointsAside) {
  PinTool tool;
  sphere_.perform(send(tool, press(sphere_.pixel_of(front_))));
  ASSERT_EQ(sphere_.state.selection.handles.size(), 1U);
  for (const double near : {4.0, 8.5}) {
    EXPECT_EQ(pin_at(beside(front_, near), sphere_.scene()), 0U) << near;
  }
  EXPECT_FALSE(pin_at(beside(front_, 9.5), sphere_.scene()).has_value());
}

TEST_P(AHand, TakesARimsDotFromAFewPointsAside) {
  DiskTool tool;
  const Vector2d rim = sphere_.pixel_of(Vector3d(std::sin(0.7), 0, std::cos(0.7)));
  send(tool, press(sphere_.pixel_of(front_)));
  send(tool, move_to(rim));
  sphere_.perform(send(tool, release(rim)));
  send(tool, move_to(sphere_.pixel_of(front_)));
  ASSERT_EQ(tool.marks().grips.size(), 8U);
  const Vector2d dot = sphere_.pixel_of(tool.marks().grips[0].position);
  const auto is_at_grip = [&](double points) {
    return tool.is_at_grip(dot + Vector2d(GetParam() * points, 0.0), sphere_.scene());
  };
  EXPECT_TRUE(is_at_grip(4.0));
  EXPECT_TRUE(is_at_grip(7.5));
  EXPECT_FALSE(is_at_grip(8.5));
}

TEST_P(AHand, DragsADiskOrARulerFromAFewPointsOn) {
  for (const double way : {3.5, 40.0}) {
    DiskTool disk;
    RulerTool ruler;
    for (SceneTool* tool : {static_cast<SceneTool*>(&disk), static_cast<SceneTool*>(&ruler)}) {
      send(*tool, press(sphere_.pixel_of(front_)));
      send(*tool, move_to(beside(front_, way)));
      send(*tool, release(beside(front_, way)));
    }
    EXPECT_EQ(disk.may_change_choice(), way < 4.0) << "clicked, not dragged";
    EXPECT_EQ(ruler.has_both_ends(), way > 4.0);
  }
}

TEST_P(AHand, ClosesALoopAFewPointsBesideItsFirstCorner) {
  for (const double way : {9.0, 11.0}) {
    LoopTool tool;
    for (const Vector3d& corner :
         {Vector3d(0, 0, 1), Vector3d(0.6, 0, 0.8), Vector3d(0, 0.6, 0.8)}) {
      send(tool, press(sphere_.pixel_of(sphere_.vertex_near(corner))));
    }
    send(tool, press(beside(front_, way)));
    EXPECT_EQ(tool.marks().line_is_done, way < 10.0) << way;
  }
}

TEST_P(AHand, PaintsWithABrushOfThatManyPoints) {
  PaintTool tool;
  tool.options().radius_pt = 30.0;
  const Vector2d middle = sphere_.pixel_of(front_);
  send(tool, press(middle));
  sphere_.perform(send(tool, release(middle)));
  ASSERT_GT(sphere_.roi().size(), 10U);
  const VertexSet& painted = sphere_.roi();
  for (Index v = 0; v < sphere_.state.rest->vertex_count(); ++v) {
    if (sphere_.state.rest->positions[v].z() < 0.2) continue;
    const bool is_near = (sphere_.pixel_of(v) - middle).norm() <= GetParam() * 30.0;
    EXPECT_EQ(std::ranges::binary_search(painted, v), is_near) << v;
  }
}

}  // namespace
}  // namespace lapwing::viewer::test
