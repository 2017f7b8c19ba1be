#include "tools/pin_tool.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {
namespace {

class APin : public ::testing::Test {
 protected:
  ToolAnswer press_at(const Vector2d& pixel, bool shift = false) {
    return sphere_.press_with(tool_, pixel, {.shift = shift});
  }
  const std::vector<ChosenHandle>& handles() const { return sphere_.state.selection.handles; }

  SphereScene sphere_;
  PinTool tool_;
  Index front_ = sphere_.vertex_near({0, 0, 1});
  Index side_ = sphere_.vertex_near({0.5, 0, 0.8});
};

TEST_F(APin, HoldsTheVertexThatIsPressedAndIsDragged) {
  const ToolAnswer answer = press_at(sphere_.pixel_of(front_));
  ASSERT_EQ(handles().size(), 1U);
  EXPECT_TRUE(is_pin(handles()[0]));
  EXPECT_EQ(handles()[0].vertices.front(), front_);
  EXPECT_EQ(handles()[0].falloff, Falloff{}) << "it goes where the hand does";
  EXPECT_EQ(answer.holds, 0U);
  EXPECT_TRUE(answer.drags_held);
}

TEST_F(APin, IsTakenHoldOfWhereOneIs) {
  press_at(sphere_.pixel_of(front_));
  press_at(sphere_.pixel_of(side_));
  ASSERT_EQ(handles().size(), 2U);
  const Vector2d beside = sphere_.pixel_of(front_) + Vector2d(3.0, -3.0);
  const ToolAnswer answer = press_at(beside);
  EXPECT_EQ(answer.holds, 0U);
  EXPECT_FALSE(answer.command.has_value());
  EXPECT_EQ(handles().size(), 2U);
}

TEST_F(APin, IsOnlySetWithShift) {
  EXPECT_FALSE(press_at({2.0, 2.0}).taken) << "beside the surface";
  EXPECT_FALSE(press_at(sphere_.pixel_of(front_), true).drags_held);
  EXPECT_EQ(handles().size(), 1U);
}

TEST_F(APin, BehindTheSurfaceIsNotTaken) {
  const Positions& positions = sphere_.state.rest->positions;
  const auto lowest =
      std::min_element(positions.begin(), positions.end(),
                       [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); });
  const auto behind = static_cast<Index>(lowest - positions.begin());
  sphere_.state = apply(std::move(sphere_.state),
                        Choose{{Part::Role::handle, 0}, {ListedVertices{{behind}}, "pin"}});
  press_at(sphere_.pixel_of(behind));
  EXPECT_EQ(handles().size(), 2U) << "the press pins what is in front";
}

}  // namespace
}  // namespace lapwing::viewer::test
