#include "navigation/camera_controller.h"

#include <gtest/gtest.h>

namespace lapwing::viewer {
namespace {

// A view of a cube. Its surface is at `place_`, wherever the cursor is.
class CameraControllerTest : public ::testing::Test {
 protected:
  CameraControllerTest() {
    camera_.resize({800.0, 600.0}, 2.0);
    camera_.set_camera(fit(Bounds{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}},
                           view_axes(View::three_quarter), 800.0 / 600.0));
  }
  void send(InputKind kind, const Eigen::Vector2d& at, double scroll = 0.0) {
    camera_.handle({.kind = kind, .position = at, .button = MouseButton::middle, .scroll = scroll},
                   keymap_named("Blender"),
                   {3.0, [this](const auto&) { return std::optional(place_); }});
  }
  Eigen::Vector2d pixel() const {
    const Camera& camera = camera_.camera();
    const Eigen::Vector3d clip =
        (camera.projection(800.0 / 600.0) * camera.view() * place_.homogeneous()).hnormalized();
    return 0.5 * (clip.head<2>() + Eigen::Vector2d::Ones()).cwiseProduct(camera_.size());
  }
  void expect_stays(const Eigen::Vector2d& before) const {
    EXPECT_LT((pixel() - before).norm(), 1e-6);
  }

  const Eigen::Vector3d place_{0.5, 0.2, -0.3};
  CameraController camera_;
};

TEST_F(CameraControllerTest, OrbitsAboutTheSurfacePointThatWasPressed) {
  const Eigen::Vector2d at = pixel();
  const Eigen::Vector3d eye = camera_.camera().eye;
  send(InputKind::press, at);
  EXPECT_TRUE(camera_.is_moving());
  send(InputKind::move, at + Eigen::Vector2d(90.0, 20.0));
  expect_stays(at);
  EXPECT_GT((camera_.camera().eye - eye).norm(), 0.1);
  send(InputKind::release, at + Eigen::Vector2d(90.0, 20.0));
  EXPECT_FALSE(camera_.is_moving());
  EXPECT_FALSE(camera_.is_click(at + Eigen::Vector2d(90.0, 20.0)));
}

TEST_F(CameraControllerTest, TheWheelZoomsToTheSurfacePointUnderTheCursor) {
  const Eigen::Vector2d at = pixel();
  const double distance = (camera_.camera().eye - place_).norm();
  send(InputKind::scroll, at, 3.0);
  expect_stays(at);
  EXPECT_LT((camera_.camera().eye - place_).norm(), 0.8 * distance);
}

TEST_F(CameraControllerTest, AReleaseWithinAFewPointsIsAClick) {
  send(InputKind::press, {100.0, 100.0});
  EXPECT_TRUE(camera_.is_click({105.0, 100.0}));
  EXPECT_FALSE(camera_.is_click({107.0, 100.0}));
}

}  // namespace
}  // namespace lapwing::viewer
