// The choices of the Display tab change the picture.
#include <gtest/gtest.h>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/gpu.h"
#include "support/keep_picture.h"
#include "viewer_panels/shown_viewer.h"

namespace lapwing::viewer::test {
namespace {

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
  EXPECT_TRUE(style().wireframe) << "X-ray was only in front of it";
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

}  // namespace
}  // namespace lapwing::viewer::test
