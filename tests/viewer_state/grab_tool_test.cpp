#include "tools/grab_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/region/geodesic.h"
#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {
namespace {

class AGrabTool : public ::testing::Test {
 protected:
  ToolAnswer press_at(const Vector2d& pixel, const Modifiers& modifiers = {}) {
    return sphere_.press_with(tool_, pixel, modifiers);
  }
  double roi_radius() const {
    const RegionSpec& roi = sphere_.state.selection.roi.made;
    return std::get<GeodesicDisk>(roi.form).radius;
  }
  const ChosenHandle& handle() const { return sphere_.state.selection.handles.at(0); }

  SphereScene sphere_;
  GrabTool tool_;
  Index front_ = sphere_.vertex_near({0, 0, 1});
  Index side_ = sphere_.vertex_near({0.8, 0, 0.5});
};

TEST_F(AGrabTool, ChoosesRegionAndHandleAtOnceAndPulls) {
  const ToolAnswer answer = press_at(sphere_.pixel_of(front_));
  EXPECT_EQ(answer.holds, 0U);
  EXPECT_TRUE(answer.drags_held);
  EXPECT_THAT(handle().vertices, testing::Contains(front_));
  ASSERT_TRUE(handle().falloff.transition);
  const double circle = sphere_.view.in_pixels(tool_.radius_pt()) *
                        sphere_.view.length_of_pixel(sphere_.state.rest->positions[front_]);
  EXPECT_NEAR(handle().falloff.transition->width, 0.5 * circle, 0.1 * circle);
  EXPECT_NEAR(roi_radius(), 3.0 * circle, 0.1 * circle);
  EXPECT_EQ(sphere_.roi(), resolve(sphere_.state.selection.roi.made, *sphere_.state.rest));
  EXPECT_FALSE(edit_region(sphere_.state).belt.empty());
}

TEST_F(AGrabTool, PullsAHalfOrATwiceAsLargePartWithShiftOrControl) {
  press_at(sphere_.pixel_of(front_));
  const double radius = roi_radius();
  press_at(sphere_.pixel_of(side_), {.shift = true});
  EXPECT_NEAR(roi_radius(), 0.5 * radius, 0.05 * radius);
  press_at(sphere_.pixel_of(front_), {.control = true});
  EXPECT_NEAR(roi_radius(), 2.0 * radius, 0.05 * radius);
}

TEST_F(AGrabTool, PullsTheHandleThatIsPressedAgain) {
  press_at(sphere_.pixel_of(front_));
  const ToolAnswer again = press_at(sphere_.pixel_of(front_));
  EXPECT_EQ(again.holds, 0U);
  EXPECT_TRUE(again.drags_held);
  EXPECT_FALSE(again.command);
  EXPECT_TRUE(press_at(sphere_.pixel_of(front_), {.shift = true}).command) << "a smaller region";
  EXPECT_TRUE(press_at(sphere_.pixel_of(side_)).command) << "another place";
}

TEST_F(AGrabTool, GrabsSomeVerticesHoweverSmallItsCircle) {
  tool_.set_radius_pt(1.0);
  press_at(sphere_.pixel_of(front_));
  EXPECT_GT(sphere_.roi().size(), 20U);
  EXPECT_NO_THROW(edit_region(sphere_.state));
}

TEST_F(AGrabTool, HasACircleThatKeysAndWheelResize) {
  const double before = tool_.marks().brush_pt;
  EXPECT_TRUE(tool_.handle(key(']'), sphere_.scene()).taken);
  const double larger = tool_.marks().brush_pt;
  EXPECT_GT(larger, before);
  EXPECT_TRUE(tool_.handle(scrolled({9.0, 9.0}, -1.0, kSizes), sphere_.scene()).taken);
  EXPECT_NEAR(tool_.marks().brush_pt, before, 1e-9);
  EXPECT_FALSE(tool_.handle(scrolled({9.0, 9.0}, -1.0, {}), sphere_.scene()).taken) << "zooms";
}

TEST_F(AGrabTool, LeavesAPressBesideTheSurfaceToTheCamera) {
  EXPECT_FALSE(press_at({2.0, 2.0}).taken);
}

}  // namespace
}  // namespace lapwing::viewer::test
