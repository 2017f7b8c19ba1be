#include "editing/guide.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "viewer_state/tube_edit.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::HasSubstr;

TEST(Guide, LeadsFromTheRegionToTheHandleAndTheDrag) {
  const DiskTool disk;
  const GizmoTool gizmo;
  AppState state = open_state(bumpy_tube());
  Guide guide = guide_of(state, kRoi, disk, false);
  EXPECT_EQ(guide.current, 0U);
  EXPECT_FALSE(guide.steps[0].is_done);
  EXPECT_THAT(guide.what, HasSubstr("region"));

  state = apply(state, Choose{kRoi, box(0.3, 4.0)});
  guide = guide_of(state, kHandle, disk, false);
  EXPECT_EQ(guide.current, 1U);
  EXPECT_TRUE(guide.steps[0].is_done);
  EXPECT_THAT(guide.what, HasSubstr("handle"));

  state = apply(state, Choose{kHandle, box(2.8, 4.0)});
  guide = guide_of(state, kHandle, gizmo, true);
  EXPECT_EQ(guide.current, 2U);
  EXPECT_TRUE(guide.steps[1].is_done);
  EXPECT_FALSE(guide.steps[2].is_done);
  EXPECT_THAT(guide.what, HasSubstr("Drag the gizmo"));

  state = apply(state, MoveHandle{0, bent()});
  guide = guide_of(state, kHandle, gizmo, true);
  EXPECT_TRUE(guide.steps[2].is_done);
  EXPECT_THAT(guide.what, HasSubstr("Ctrl+N"));
}

TEST(Guide, SaysWhatIsMissingToWhoeverWouldMove) {
  const GizmoTool gizmo;
  AppState state = open_state(bumpy_tube());
  EXPECT_THAT(guide_of(state, kRoi, gizmo, true).what, HasSubstr("Press I"));
  state = apply(state, Choose{kRoi, box(0.3, 4.0)});
  EXPECT_THAT(guide_of(state, kHandle, gizmo, true).what, HasSubstr("Press H"));
}

// The number of the step and the words below it are about the same thing.
TEST(Guide, HasTheStepOfItsWords) {
  const GizmoTool gizmo;
  const DiskTool disk;
  AppState state = open_state(bumpy_tube());
  EXPECT_EQ(guide_of(state, kRoi, gizmo, true).current, 0U);
  EXPECT_EQ(guide_of(state, kHandle, gizmo, true).current, 0U);
  EXPECT_EQ(guide_of(state, kHandle, disk, false).current, 1U);
  EXPECT_THAT(guide_of(state, kHandle, disk, false).what, HasSubstr("handle"));
  state = apply(state, Choose{kRoi, box(0.3, 4.0)});
  EXPECT_EQ(guide_of(state, kRoi, gizmo, true).current, 1U);
  EXPECT_THAT(guide_of(state, kRoi, gizmo, true).what, HasSubstr("handle"));
  const Guide guide = guide_of(state, {Part::Role::belt}, disk, false);
  EXPECT_EQ(guide.current, guide.count) << "no step selects the fixed border";
}

TEST(Guide, OfAPinIsAboutTheHandle) {
  const PinTool pin;
  const Guide guide = guide_of(open_state(bumpy_tube()), kHandle, pin, false);
  EXPECT_EQ(guide.steps.at(guide.current).name, std::string("Handle"));
  EXPECT_THAT(guide.what, HasSubstr("pin"));
}

TEST(Guide, OfAPaintedPartSaysThatEnterGoesOn) {
  const PaintTool paint;
  AppState state = open_state(bumpy_tube());
  EXPECT_THAT(guide_of(state, kRoi, paint, false).what, HasSubstr("Paint the region"));
  state = apply(state, Choose{kRoi, box(0.3, 4.0)});
  EXPECT_THAT(guide_of(state, kRoi, paint, false).what, HasSubstr("Enter continues"));
}

}  // namespace
}  // namespace lapwing::viewer::test
