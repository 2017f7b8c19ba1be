#include "navigation/camera_motion.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector2d kSize(800.0, 600.0);
constexpr ZoomRange kRange{1e-3, 1e3};

Camera some_camera(bool orthographic) {
  Camera camera =
      fit(Bounds{Vector3d(-1, -2, -3), Vector3d(4, 2, 1)}, view_axes(View::three_quarter),
          kSize.x() / kSize.y(), {.orthographic = orthographic});
  camera.target_across = 0.25;
  return camera;
}

Vector2d pixel_of(const Camera& camera, const Vector3d& point) {
  const Vector3d clip =
      (camera.projection(kSize.x() / kSize.y()) * camera.view() * point.homogeneous())
          .hnormalized();
  return 0.5 * (clip.head<2>() + Vector2d::Ones()).cwiseProduct(kSize);
}

double distance_of(const Camera& camera) {
  return (camera.eye - camera.target).norm();
}

class CameraMotion : public ::testing::TestWithParam<bool> {
 protected:
  const Camera camera = some_camera(GetParam());
};

TEST_P(CameraMotion, OrbitKeepsTargetAndDistance) {
  const Camera moved = orbited(camera, {123.0, -45.0}, kSize, Vector3d::UnitY(), camera.target);
  EXPECT_LT((moved.target - camera.target).norm(), 1e-12);
  EXPECT_NEAR(distance_of(moved), distance_of(camera), 1e-12);
  EXPECT_GT((moved.eye - camera.eye).norm(), 0.1);
}

TEST_P(CameraMotion, OrbitKeepsTheHorizonLevel) {
  Camera moved = camera;
  for (int step = 0; step < 50; ++step) {
    moved = orbited(moved, {7.0 * step, 31.0 - step}, kSize, Vector3d::UnitY(), {1.0, 0.5, -1.0});
  }
  const Vector3d right = moved.view().block<1, 3>(0, 0).transpose();
  EXPECT_NEAR(right.y(), 0.0, 1e-9);
}

TEST_P(CameraMotion, OrbitSidewaysByTheHeightIsHalfATurn) {
  const Camera moved = orbited(camera, {kSize.y(), 0.0}, kSize, Vector3d::UnitY(), camera.target);
  const Vector3d before = camera.eye - camera.target;
  const Vector3d after = moved.eye - moved.target;
  EXPECT_LT((after - Vector3d(-before.x(), before.y(), -before.z())).norm(), 1e-9);
}

TEST_P(CameraMotion, OrbitStopsWhereItLooksStraightDown) {
  Camera moved = orbited(camera, {0.0, 10.0 * kSize.y()}, kSize, Vector3d::UnitY(), camera.target);
  EXPECT_LT(((moved.eye - moved.target).normalized() - Vector3d::UnitY()).norm(), 1e-6);
  moved = orbited(moved, {0.0, -0.5 * kSize.y()}, kSize, Vector3d::UnitY(), moved.target);
  EXPECT_NEAR((moved.eye - moved.target).normalized().y(), 0.0, 1e-6);
  EXPECT_GT(moved.up.y(), 0.99);
}

TEST_P(CameraMotion, OrbitKeepsThePlaceOfItsCentreInTheImage) {
  const Vector3d center(2.5, -1.0, 0.5);
  const Camera moved = orbited(camera, {80.0, 33.0}, kSize, Vector3d::UnitY(), center);
  EXPECT_LT((pixel_of(moved, center) - pixel_of(camera, center)).norm(), 1e-9);
  EXPECT_GT((pixel_of(moved, camera.target) - pixel_of(camera, camera.target)).norm(), 10.0);
}

TEST_P(CameraMotion, FocusKeepsTheImageAndTakesTheTargetToTheDepth) {
  const Vector3d point(2.5, -1.0, 0.5);
  const Camera moved = focused(camera, point);
  for (const Vector3d& seen : {point, Vector3d(-1.0, 2.0, -3.0), Vector3d(4.0, 0.0, 1.0)}) {
    EXPECT_LT((pixel_of(moved, seen) - pixel_of(camera, seen)).norm(), 1e-9);
  }
  EXPECT_NEAR((moved.eye - moved.target).dot(moved.target - point), 0.0, 1e-9);
}

TEST_P(CameraMotion, AfterFocusZoomKeepsThePointAndStaysBeforeIt) {
  const Vector3d point(2.5, -1.0, 0.5);
  const Vector2d pixel = pixel_of(camera, point);
  Camera moved = camera;
  for (int notch = 0; notch < 200; ++notch) {
    moved = zoomed(focused(moved, point), 1.15, pixel, kSize, zoom_range(10.0));
  }
  EXPECT_LT((pixel_of(moved, point) - pixel).norm(), 1e-6);
  EXPECT_NEAR((moved.eye - moved.target).dot(moved.eye - point), 1e-4, 1e-9)
      << "a thousandth of the size, squared";
}

TEST_P(CameraMotion, ZoomDoesNotMoveAwayFromWhatIsNearerThanItsRange) {
  const ZoomRange range{2.0 * distance_of(camera), 1e3};
  EXPECT_NEAR(distance_of(zoomed(camera, 1.15, {10, 10}, kSize, range)), distance_of(camera), 1e-9);
  EXPECT_GT(distance_of(zoomed(camera, 0.5, {10, 10}, kSize, range)), 1.5 * distance_of(camera));
}

TEST_P(CameraMotion, PanMovesTheTargetWithTheCursor) {
  const Vector2d moved_by(37.0, -81.0);
  const Camera moved = panned(camera, moved_by, kSize);
  EXPECT_LT((pixel_of(moved, camera.target) - pixel_of(camera, camera.target) - moved_by).norm(),
            1e-9);
}

TEST_P(CameraMotion, ZoomKeepsWhatIsUnderTheCursor) {
  const Vector2d cursor(612.0, 99.0);
  const Ray ray = line_of_sight(camera, cursor, kSize);
  const Vector3d ahead = (camera.target - camera.eye).normalized();
  const Vector3d under =
      ray.origin + ahead.dot(camera.target - ray.origin) / ahead.dot(ray.direction) * ray.direction;
  const Camera moved = zoomed(camera, 1.7, cursor, kSize, kRange);
  EXPECT_LT((pixel_of(moved, under) - cursor).norm(), 1e-9);
  EXPECT_NEAR(distance_of(moved), distance_of(camera) / 1.7, 1e-12);
}

TEST_P(CameraMotion, ZoomStopsAtItsRange) {
  const double distance = distance_of(camera);
  const ZoomRange range{0.5 * distance, 3.0 * distance};
  EXPECT_NEAR(distance_of(zoomed(camera, 1e6, {10, 10}, kSize, range)), range.nearest, 1e-9);
  EXPECT_NEAR(distance_of(zoomed(camera, 1e-6, {10, 10}, kSize, range)), range.farthest, 1e-9);
}

TEST_P(CameraMotion, LookingFromASideKeepsTargetAndDistance) {
  for (const View view : {View::front, View::top, View::left}) {
    const ViewAxes axes = view_axes(view, UpAxis::z);
    const Camera moved = looking_from(camera, axes);
    EXPECT_EQ(moved.target, camera.target);
    EXPECT_LT((moved.eye - moved.target - distance_of(camera) * axes.toward_eye).norm(), 1e-9);
    EXPECT_EQ(moved.up, axes.up);
  }
}

INSTANTIATE_TEST_SUITE_P(Projections, CameraMotion, ::testing::Bool());

}  // namespace
}  // namespace lapwing::viewer
