// The choices of the Display tab change the picture.
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_panels/bent_tube.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

using Eigen::Vector2d;

class Display : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    viewer_ = std::make_unique<ShownViewer>(std::make_shared<gpu::Context>());
    write_mesh(torus(48, 24, 1.0, 0.4), viewer_->folder() / "ring.obj");
    viewer_->open(viewer_->folder() / "ring.obj");
    viewer_->click("Display");
  }

  SurfaceStyle style() { return viewer_->app().scene().style; }
  void keep(const std::string& name) {
    lapwing::test::keep_picture(viewer_->picture(), "display-" + name);
  }

  std::unique_ptr<ShownViewer> viewer_;
};

TEST_F(Display, ChoosesTheShadingByThePanelAndByKeys) {
  viewer_->click("X-ray");
  EXPECT_TRUE(style().xray);
  EXPECT_FALSE(style().wireframe);
  keep("xray");
  viewer_->click("Wireframe");
  EXPECT_FALSE(style().xray);
  EXPECT_TRUE(style().wireframe);
  viewer_->key('Z', {.alt = true});
  EXPECT_TRUE(style().xray);
  viewer_->key('Z', {.alt = true});
  EXPECT_FALSE(style().xray);
  EXPECT_TRUE(style().wireframe) << "X-ray did not turn off the wireframe";
  viewer_->click("Solid");
  EXPECT_FALSE(style().wireframe);
  viewer_->key('Z', {.alt = true});
  viewer_->key('Z', {.shift = true});
  EXPECT_TRUE(style().wireframe);
  EXPECT_FALSE(style().xray);
}

TEST_F(Display, ChoosesAMatcap) {
  for (const auto& [name, matcap] : {std::pair{"Clay", Matcap::clay},
                                     {"Metal", Matcap::metal},
                                     {"Pearl", Matcap::pearl},
                                     {"Off", Matcap::none}}) {
    viewer_->click(name);
    EXPECT_EQ(style().matcap, matcap) << name;
    keep(name);
  }
}

TEST_F(Display, DrawsAGroundGridThatTheDepthRangeIncludes) {
  EXPECT_FALSE(viewer_->app().scene().grid);
  const double far_before = viewer_->app().scene().camera.far_distance;
  viewer_->click("Ground grid");
  const Scene scene = viewer_->app().scene();
  ASSERT_TRUE(scene.grid);
  EXPECT_EQ(scene.grid->spacing, 0.2);
  EXPECT_NEAR(scene.grid->center.y(), viewer_->app().document()->editor.bounds().min.y(), 0.01);
  EXPECT_GT(scene.camera.far_distance, far_before + 1.0);
  keep("grid");
}

class ComparisonSlider : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    viewer_ = std::make_unique<ShownViewer>(std::make_shared<gpu::Context>());
    viewer_->open(write_bent_tube(viewer_->folder(), 2));
    viewer_->wait_for([&] { return viewer_->says("Ready: refines while dragging"); },
                      "the edit is prepared");
    viewer_->click("Lasso");  // hides the handle's gizmo
    viewer_->click("Display");
    viewer_->click("Plain");
  }

  // Compares two pictures in the columns from `left` to `right`, without texts and gizmo.
  static bool agree(const Image& a, const Image& b, std::uint32_t left, std::uint32_t right) {
    for (std::uint32_t y = 160; y < 700; ++y) {
      for (std::uint32_t x = left; x < right; ++x) {
        if (a.pixel(x, y) != b.pixel(x, y)) return false;
      }
    }
    return true;
  }
  // The line is in the middle of the area that the sidebar does not cover.
  std::uint32_t line() {
    return static_cast<std::uint32_t>(viewer_->app().scene().left.value().width);
  }

  std::unique_ptr<ShownViewer> viewer_;
};

TEST_F(ComparisonSlider, ShowsTheOriginalAtTheLeftAndTheEditedMeshAtTheRight) {
  constexpr std::uint32_t kLeft = 410;
  constexpr std::uint32_t kRight = 1270;
  constexpr std::uint32_t kGap = 10;
  const Image edited = viewer_->picture();
  viewer_->key('C');
  const Image original = viewer_->picture();
  viewer_->key('C', {.shift = true});
  const Image both = viewer_->picture();
  lapwing::test::keep_picture(both, "slider");
  const std::uint32_t at = line();
  EXPECT_TRUE(agree(both, original, kLeft, at - kGap));
  EXPECT_TRUE(agree(both, edited, at + kGap, kRight));
  EXPECT_FALSE(agree(original, edited, kLeft, at - kGap));
  EXPECT_FALSE(agree(original, edited, at + kGap, kRight));
  viewer_->key('C', {.shift = true});
  EXPECT_EQ(viewer_->picture().rgba, edited.rgba) << "it is off again";
}

TEST_F(ComparisonSlider, IsDraggedByItsLine) {
  viewer_->key('C', {.shift = true});
  const Vector2d from(line(), 600.0);
  const Camera camera = viewer_->app().scene().camera;
  const std::size_t steps = viewer_->app().document()->editor.session().history().done();
  viewer_->drag(from, {1000.0, 500.0});
  EXPECT_EQ(line(), 1000U);
  EXPECT_EQ(viewer_->app().scene().camera, camera);
  viewer_->drag({1000.0, 500.0}, {5.0, 500.0});
  EXPECT_NEAR(line(), 390.0, 20.0) << "the line stops at the sidebar";
  EXPECT_EQ(viewer_->app().document()->editor.session().history().done(), steps)
      << "no tool acts on the line";
}

}  // namespace
}  // namespace lapwing::viewer::test
