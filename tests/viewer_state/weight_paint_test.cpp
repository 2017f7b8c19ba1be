#include "tools/weight_paint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::Le;

class PaintingAWeight : public ::testing::Test {
 protected:
  ToolAnswer send(const InputEvent& event) { return tool_.handle(event, sphere_.scene()); }
  void stroke(Modifiers modifiers = {}) {
    send(press(left_, modifiers));
    send(move_to(right_, modifiers));
    EXPECT_FALSE(send(release(right_, modifiers)).command) << "nothing is chosen by it";
  }
  double weight_at(const Vector3d& place) const {
    return tool_.field().at(sphere_.vertex_near(place));
  }

  SphereScene sphere_;
  WeightPaint tool_;
  Vector2d left_ = sphere_.pixel_of(Vector3d(-0.3, 0, 0.95));
  Vector2d right_ = sphere_.pixel_of(Vector3d(0.3, 0, 0.95));
  const Vector3d middle_{0.0, 0.0, 1.0};
  const Vector3d beside_{0.0, 0.7, 0.71};
};

TEST_F(PaintingAWeight, AStrokeSetsWhatItTouches) {
  tool_.strength = 0.5;
  stroke();
  EXPECT_EQ(weight_at(middle_), 0.5);
  EXPECT_EQ(weight_at(beside_), 0.0);
  EXPECT_EQ(tool_.field().size(), sphere_.state.rest->vertex_count());
  tool_.strength = 1.0;
  stroke();
  EXPECT_EQ(weight_at(middle_), 1.0);
}

TEST_F(PaintingAWeight, ControlErases) {
  stroke();
  stroke({.control = true});
  EXPECT_THAT(tool_.field(), Each(0.0));
}

TEST_F(PaintingAWeight, AStrokeUnderWayIsShownAndNotYetDone) {
  send(press(left_));
  send(move_to(right_));
  EXPECT_TRUE(tool_.is_dragging());
  EXPECT_THAT(tool_.field(), Each(0.0));
  EXPECT_EQ(tool_.live_field().at(sphere_.vertex_near(middle_)), 1.0);
}

TEST_F(PaintingAWeight, SofteningLeavesNumbersFromNoneToAll) {
  stroke();
  const double before = tool_.field().at(sphere_.vertex_near(middle_));
  for (int k = 0; k < 10; ++k) tool_.soften(sphere_.state.rest->topology());
  EXPECT_THAT(tool_.field(), Each(AllOf(Ge(0.0), Le(1.0))));
  EXPECT_LT(tool_.field().at(sphere_.vertex_near(middle_)), before);
}

}  // namespace
}  // namespace lapwing::viewer::test
