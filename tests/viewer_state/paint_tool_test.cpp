#include "tools/paint_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/screen_geometry.h"
#include "tools/selection_edits.h"
#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::ElementsAre;
using Shape = PaintTool::Shape;

class Painting : public ::testing::Test {
 protected:
  ToolAnswer send(const InputEvent& event) { return tool_.handle(event, sphere_.scene()); }
  void stroke(const std::vector<Vector2d>& way, Modifiers modifiers = {}) {
    send(press(way.front(), modifiers));
    for (const Vector2d& pixel : way) send(move_to(pixel, modifiers));
    sphere_.perform(send(release(way.back(), modifiers)));
  }
  bool any_hidden() const {
    const ToolScene scene = sphere_.scene();
    return std::any_of(sphere_.roi().begin(), sphere_.roi().end(),
                       [&](Index v) { return !scene.is_visible(v); });
  }

  SphereScene sphere_;
  PaintTool tool_;
  Vector2d left_ = sphere_.pixel_of(Vector3d(-0.5, 0, 0.86));
  Vector2d right_ = sphere_.pixel_of(Vector3d(0.5, 0, 0.86));
};

TEST_F(Painting, BrushLeavesNoGapBetweenTwoEvents) {
  stroke({left_, right_});
  for (const double x : {-0.5, -0.2, 0.0, 0.3, 0.5}) {
    const Index v = sphere_.vertex_near({x, 0, std::sqrt(1 - x * x)});
    EXPECT_TRUE(std::binary_search(sphere_.roi().begin(), sphere_.roi().end(), v));
  }
  EXPECT_FALSE(any_hidden());
}

TEST_F(Painting, ThroughReachesTheFarSide) {
  tool_.options().through = true;
  stroke({left_, right_});
  EXPECT_TRUE(any_hidden());
}

TEST_F(Painting, AStrokeIsOneStepUnlessItIsGivenUpOrChangesNothing) {
  send(press(left_));
  EXPECT_FALSE(send(move_to(right_)).command.has_value());
  EXPECT_FALSE(tool_.live().empty());
  sphere_.perform(send(release(right_)));
  EXPECT_FALSE(sphere_.roi().empty());
  EXPECT_TRUE(tool_.live().empty());
  send(press(left_));
  EXPECT_FALSE(send(release(right_)).command.has_value()) << "it would change nothing";
  stroke({left_, right_}, {.control = true});
  EXPECT_TRUE(sphere_.roi().empty());
  send(press(left_));
  send(key(kEscape));
  EXPECT_FALSE(send(release(right_)).command.has_value()) << "given up";
}

TEST_F(Painting, BoxHoldsWhatShowsInIt) {
  tool_.options().shape = Shape::box;
  stroke({left_ - Vector2d(0, 40), right_ + Vector2d(0, 40)});
  ASSERT_FALSE(sphere_.roi().empty());
  for (const Index v : sphere_.roi()) {
    EXPECT_GE(sphere_.pixel_of(v).x(), left_.x());
    EXPECT_LE(sphere_.pixel_of(v).x(), right_.x());
  }
}

TEST_F(Painting, LassoHoldsWhatItGoesAround) {
  tool_.options().shape = Shape::lasso;
  const Vector2d top = sphere_.pixel_of(Vector3d(0, 0.6, 0.8));
  stroke({left_, right_, top});
  const VertexSet triangle = sphere_.roi();
  ASSERT_FALSE(triangle.empty());
  tool_.options().shape = Shape::box;
  stroke({left_, {right_.x(), top.y()}});
  EXPECT_TRUE(subtract(triangle, sphere_.roi()).empty()) << "the box around it holds it";
  EXPECT_GT(sphere_.roi().size(), triangle.size() + triangle.size() / 2);
}

TEST_F(Painting, KeysAndScrollingChangeTheBrush) {
  const double radius = tool_.options().radius_pt;
  send(key(']'));
  EXPECT_GT(tool_.options().radius_pt, radius);
  send(press(left_));
  EXPECT_TRUE(send(scrolled(left_, -1.0, kSizes)).taken);
  EXPECT_NEAR(tool_.options().radius_pt, radius, 1e-9);
  EXPECT_TRUE(send(scrolled(left_, -1.0)).taken) << "nothing zooms under a stroke";
  EXPECT_NEAR(tool_.options().radius_pt, radius, 1e-9);
  sphere_.perform(send(release(left_)));
  EXPECT_FALSE(send(scrolled(left_, 1.0)).taken) << "the camera's, between strokes";
  EXPECT_TRUE(send(scrolled(left_, 1.0, kSizes)).taken);
  EXPECT_GT(tool_.options().radius_pt, radius);
}

class Editing : public ::testing::Test {
 protected:
  Editing() {
    choose_part({Part::Role::roi}, {GeodesicDisk{Index{0}, 0.8}});
    choose_part(handle_, {GeodesicDisk{Index{0}, 0.3}});
  }
  void choose_part(const Part& part, RegionSpec spec) {
    state_ = apply(state_, Choose{part, std::move(spec)});
  }
  const VertexSet& roi() const { return state_.selection.roi.vertices; }
  const VertexSet& handle() const { return state_.selection.handles[0].vertices; }
  void perform(const std::optional<Command>& command) {
    ASSERT_TRUE(command.has_value());
    state_ = apply(state_, *command);
  }

  const Part roi_{Part::Role::roi};
  const Part handle_{Part::Role::handle, 0};
  AppState state_ = open_state(icosphere(4));
};

TEST_F(Editing, GrowAddsTheRingAndShrinkTakesItBack) {
  const VertexSet before = roi();
  perform(grow(state_, roi_));
  EXPECT_EQ(roi(), with_ring_neighbours(before, state_.rest->topology().rings));
  perform(shrink(state_, roi_));
  EXPECT_EQ(roi(), before);
}

TEST_F(Editing, InvertTwiceIsNothing) {
  const VertexSet before = roi();
  perform(invert(state_, roi_));
  EXPECT_TRUE(intersect(before, roi()).empty());
  perform(invert(state_, roi_));
  EXPECT_EQ(roi(), before);
}

TEST_F(Editing, AllAndNothingCanBeChosenOfThePartInHand) {
  perform(choose_all(state_, handle_));
  EXPECT_EQ(handle(), roi());
  EXPECT_FALSE(choose_all(state_, handle_).has_value());
  perform(choose_all(state_, roi_));
  EXPECT_EQ(roi().size(), state_.rest->vertex_count());
  EXPECT_FALSE(choose_all(state_, roi_).has_value());
  perform(clear(state_, handle_));
  EXPECT_TRUE(state_.selection.handles.empty());
  EXPECT_FALSE(clear(state_, handle_).has_value());
  const Part belt{Part::Role::belt};
  EXPECT_FALSE(clear(state_, belt).has_value()) << "it goes by its width";
  perform(choose_all(state_, belt));
  perform(clear(state_, belt));
  EXPECT_TRUE(state_.selection.belt_fraction.has_value());
  perform(clear(state_, roi_));
  EXPECT_TRUE(roi().empty());
  EXPECT_FALSE(clear(state_, roi_).has_value());
}

TEST_F(Editing, HandleGrowsNoFartherThanTheRoi) {
  for (int k = 0; k < 40; ++k) {
    if (const auto command = grow(state_, handle_)) state_ = apply(state_, *command);
  }
  EXPECT_EQ(handle(), roi());
  EXPECT_FALSE(grow(state_, handle_).has_value());
}

TEST_F(Editing, HandleTakesNothingFromAnother) {
  const Part second{Part::Role::handle, 1};
  perform(paint(state_, second, roi(), false));
  EXPECT_EQ(unite(handle(), vertices_of(state_.selection, second)), roi());
  EXPECT_TRUE(intersect(handle(), vertices_of(state_.selection, second)).empty());
}

TEST_F(Editing, BeltByHandKeepsOutOfHandles) {
  const Part belt{Part::Role::belt};
  perform(paint(state_, belt, roi(), false));
  EXPECT_EQ(state_.selection.belt.vertices, subtract(roi(), handle()));
  EXPECT_FALSE(grow(state_, handle_).has_value());
}

TEST(ScreenSelection, IsExactOnAnEdge) {
  const std::vector<Vector2d> pixels{{0, 0}, {10, 0}, {10, 10}, {5, 3}, {30, 30}};
  EXPECT_THAT(near_line(pixels, {0, 3}, {20, 3}, 3.0), ElementsAre(0, 1, 3));
  EXPECT_THAT(in_rectangle(pixels, {10, 10}, {0, 0}), ElementsAre(0, 1, 2, 3));
  const std::vector<Vector2d> triangle{{0.5, -1}, {12, -1}, {12, 10.5}};
  EXPECT_THAT(in_polygon(pixels, triangle), ElementsAre(1, 3));
}

TEST(ScreenSelection, WhatIsBehindTheEyeIsNeverChosen) {
  const Projection view = perspective({0, 0, 5}, {0, 0, 0});
  const std::vector<Vector3d> positions{{0, 0, 0}, {0, 0, 9}};
  const auto pixels = vertex_pixels(positions, view);
  EXPECT_THAT(near_line(pixels, {400, 300}, {400, 300}, 1e9), ElementsAre(0));
  EXPECT_THAT(in_rectangle(pixels, {-1e9, -1e9}, {1e9, 1e9}), ElementsAre(0));
}

}  // namespace
}  // namespace lapwing::viewer::test
