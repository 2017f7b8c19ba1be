#include "tools/ruler_tool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "viewer_state/sphere_scene.h"

namespace lapwing::viewer::test {
namespace {

using ::testing::HasSubstr;

// On the unit sphere, where an arc is an angle.
class ARuler : public ::testing::Test {
 protected:
  ToolAnswer send(const InputEvent& event) { return tool_.handle(event, sphere_.scene()); }
  void click(const Vector2d& pixel) {
    send(press(pixel));
    send(release(pixel));
  }
  void follow(std::span<const Vector3d> positions, bool still) {
    tool_.follow(surface_of(sphere_.state)->shared_topology(), positions, still);
  }
  const Positions& rest() const { return sphere_.state.rest->positions; }
  Positions scaled(double factor) const {
    Positions positions = rest();
    for (Vector3d& p : positions) p *= factor;
    return positions;
  }

  SphereScene sphere_;
  RulerTool tool_;
  Index a_ = sphere_.vertex_near({std::sin(-0.5), 0.0, std::cos(0.5)});
  Index b_ = sphere_.vertex_near({std::sin(0.6), 0.0, std::cos(0.6)});
  double angle_ = std::acos(rest()[a_].dot(rest()[b_]));
};

TEST_F(ARuler, MeasuresStraightAndAlongTheSurface) {
  EXPECT_FALSE(send(press({5, 5})).taken) << "beside the surface it is for the camera";
  click(sphere_.pixel_of(a_));
  EXPECT_FALSE(tool_.has_both_ends());
  EXPECT_EQ(tool_.marks().dots, std::vector{a_});
  click(sphere_.pixel_of(b_));
  ASSERT_TRUE(tool_.has_both_ends());
  EXPECT_DOUBLE_EQ(tool_.straight(), (rest()[a_] - rest()[b_]).norm());
  EXPECT_NEAR(tool_.along(), angle_, 0.02 * angle_);
  EXPECT_GT(tool_.along(), tool_.straight());
  EXPECT_EQ(tool_.line().front(), rest()[a_]);
  EXPECT_EQ(tool_.line().back(), rest()[b_]);
  std::string text;
  tool_.read_out(text);
  EXPECT_THAT(text, HasSubstr("along the surface"));
}

TEST_F(ARuler, IsDrawnByADragAsWell) {
  send(press(sphere_.pixel_of(a_)));
  send(move_to(sphere_.pixel_of(b_)));
  send(release(sphere_.pixel_of(b_)));
  ASSERT_TRUE(tool_.has_both_ends());
  EXPECT_DOUBLE_EQ(tool_.straight(), (rest()[a_] - rest()[b_]).norm());
}

TEST_F(ARuler, GoesWithTheSurface) {
  click(sphere_.pixel_of(a_));
  click(sphere_.pixel_of(b_));
  const double straight = tool_.straight();
  const double along = tool_.along();
  for (const bool still : {false, true}) {
    follow(scaled(1.5), still);
    EXPECT_NEAR(tool_.straight(), 1.5 * straight, 1e-9);
    EXPECT_NEAR(tool_.along(), 1.5 * along, 1e-9);
    EXPECT_LT((tool_.line().back() - 1.5 * rest()[b_]).norm(), 1e-12);
  }
  follow(rest(), true);
  EXPECT_DOUBLE_EQ(tool_.along(), along);
}

TEST_F(ARuler, EscapeRemovesItAndThenIsSomebodyElses) {
  click(sphere_.pixel_of(a_));
  click(sphere_.pixel_of(b_));
  EXPECT_TRUE(send(key(kEscape)).taken);
  EXPECT_FALSE(tool_.is_begun());
  EXPECT_FALSE(send(key(kEscape)).taken);
}

TEST_F(ARuler, AnotherClickBeginsAnew) {
  click(sphere_.pixel_of(a_));
  click(sphere_.pixel_of(b_));
  click(sphere_.pixel_of(b_));
  EXPECT_FALSE(tool_.has_both_ends());
  EXPECT_EQ(tool_.marks().dots, std::vector{b_});
}

TEST_F(ARuler, IsRemovedWithItsTriangles) {
  click(sphere_.pixel_of(a_));
  click(sphere_.pixel_of(b_));
  const Mesh other = icosphere(2);
  tool_.follow(other.shared_topology(), other.positions, true);
  EXPECT_FALSE(tool_.is_begun());
}

}  // namespace
}  // namespace lapwing::viewer::test
