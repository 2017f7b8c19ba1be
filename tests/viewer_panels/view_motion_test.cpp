// The mouse moves the view of the whole viewer.
#include <algorithm>

#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

class ViewMotion : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    viewer_ = std::make_unique<ShownViewer>(std::make_shared<gpu::Context>());
    write_mesh(rippled_cylinder(24, 41), viewer_->folder() / "tube.obj");
    viewer_->open(viewer_->folder() / "tube.obj");
  }

  Camera camera() { return viewer_->app().scene().camera; }

  ViewFrame view() {
    return {camera(), Vector2d(viewer_->look().size.width, viewer_->look().size.height)};
  }
  std::optional<SurfacePoint> surface_at(const Vector2d& pixel) {
    const ShownSurface& shown = viewer_->app().document()->editor.view().shown();
    return pick_surface(shown.topology(), shown.positions(),
                        view().projection().ray_through(pixel));
  }
  Vector2d pixel_of(const Vector3d& point) { return view().projection().to_pixel(point).value(); }

  void scroll(double notches, const Vector2d& at) {
    viewer_->app().handle({.kind = InputKind::scroll, .position = at, .scroll = notches});
  }
  void drag_middle(const Vector2d& from, const Vector2d& to) {
    constexpr auto kMiddle = MouseButton::middle;
    ViewerApp& app = viewer_->app();
    app.handle({.kind = InputKind::press, .position = from, .button = kMiddle});
    app.handle({.kind = InputKind::move, .position = to, .button = kMiddle});
    app.handle({.kind = InputKind::release, .position = to, .button = kMiddle});
  }

  std::unique_ptr<ShownViewer> viewer_;
};

TEST_F(ViewMotion, OrbitsAboutTheSurfaceUnderTheCursor) {
  for (const bool orthographic : {false, true}) {
    if (orthographic) viewer_->key('5');
    const Vector2d at(860.5, 300.5);
    const Vector3d point = surface_at(at).value().position;
    drag_middle(at, at + Vector2d(120.0, 40.0));
    EXPECT_LT((pixel_of(point) - at).norm(), 1e-6) << orthographic;
  }
}

TEST_F(ViewMotion, OrbitsAboutTheTargetBesideTheSurface) {
  const Camera before = camera();
  drag_middle({1200.0, 90.0}, {1100.0, 120.0});
  EXPECT_LT((camera().target - before.target).norm(), 1e-12);
  EXPECT_GT((camera().eye - before.eye).norm(), 0.1);
}

TEST_F(ViewMotion, TheWheelNeverTakesTheEyeThroughTheSurface) {
  for (const bool orthographic : {false, true}) {
    if (orthographic) viewer_->key('5');
    viewer_->key(kHome);
    const Vector2d at(860.5, 300.5);
    const Vector3d point = surface_at(at).value().position;
    for (int notch = 0; notch < 200; ++notch) scroll(1.0, at);
    const Vector3d ahead = (camera().target - camera().eye).normalized();
    EXPECT_GT(ahead.dot(point - camera().eye), 0.0) << "the point is in front of the eye";
    EXPECT_LT((surface_at(at).value().position - point).norm(), 1e-3)
        << "it is still under the cursor";
  }
}

TEST_F(ViewMotion, AClickOnTheAxisGizmoLooksAlongTheAxisAndADragOrbits) {
  lapwing::test::keep_picture(viewer_->picture(), "axis-gizmo");
  // A panel also contains the text "X", but the gizmo is drawn first.
  const std::vector<ShownText>& texts = viewer_->look_at();
  const auto x = std::find_if(texts.begin(), texts.end(),
                              [](const ShownText& text) { return text.words == "X"; });
  ASSERT_NE(x, texts.end());
  const Vector2d at(static_cast<double>(x->middle().x), static_cast<double>(x->middle().y));
  viewer_->send({.kind = InputKind::press, .position = at, .button = MouseButton::left});
  viewer_->send({.kind = InputKind::release, .position = at, .button = MouseButton::left});
  EXPECT_LT(((camera().eye - camera().target).normalized() - Vector3d::UnitX()).norm(), 1e-9);
  const Vector3d target = camera().target;
  viewer_->drag(at, at + Vector2d(50.0, 20.0));
  EXPECT_GT(((camera().eye - camera().target).normalized() - Vector3d::UnitX()).norm(), 0.1);
  EXPECT_LT((camera().target - target).norm(), 1e-12);
  EXPECT_TRUE(viewer_->app().document()->editor.state().selection.handles.empty())
      << "no tool acts there";
}

}  // namespace
}  // namespace lapwing::viewer::test
