#include "navigation/axis_gizmo.h"

#include <gtest/gtest.h>

#include "navigation/camera_motion.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Camera camera_of(View view, UpAxis up) {
  return fit(Bounds{Vector3d(-1, -1, -1), Vector3d(1, 1, 1)}, view_axes(view, up), 1.0);
}

Vector3d direction_of(const AxisEnd& end) {
  return (end.positive ? 1.0 : -1.0) * Vector3d::Unit(end.axis);
}

TEST(AxisGizmo, EndsPointAlongTheAxesInTheImage) {
  for (const AxisEnd& end : axis_ends(camera_of(View::front, UpAxis::y))) {
    const Vector3d direction = direction_of(end);
    const Vector2d expected = kAxisPt * Vector2d(direction.x(), -direction.y());
    EXPECT_LT((end.offset_pt - expected).norm(), 1e-9);
  }
}

TEST(AxisGizmo, TheNearestEndIsDrawnLastAndHitFirst) {
  const Camera camera = camera_of(View::front, UpAxis::y);
  EXPECT_EQ(direction_of(axis_ends(camera).back()), Vector3d(0, 0, 1));
  EXPECT_EQ(direction_of(axis_end_at(camera, Vector2d::Zero()).value()), Vector3d(0, 0, 1));
  EXPECT_FALSE(axis_end_at(camera, Vector2d(0.5 * kAxisPt, 0.0)));
}

TEST(AxisGizmo, LooksFromTheEndThatIsClicked) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    const Camera camera = camera_of(View::three_quarter, up);
    for (const AxisEnd& end : axis_ends(camera)) {
      const auto hit = axis_end_at(camera, end.offset_pt);
      ASSERT_TRUE(hit);
      const Camera moved = looking_from(camera, view_axes(view_from(*hit, up), up));
      EXPECT_LT(((moved.eye - moved.target).normalized() - direction_of(end)).norm(), 1e-9);
    }
  }
}

}  // namespace
}  // namespace lapwing::viewer
