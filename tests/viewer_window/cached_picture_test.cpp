#include "window/cached_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/gpu/context.h"
#include "lapwing/render/point_cloud.h"
#include "support/gpu.h"
#include "viewer_window/desktop.h"
#include "viewer_window/test_frames.h"
#include "window/frame_painter.h"
#include "window/offscreen_screen.h"

namespace lapwing::viewer {
namespace {

using test::DraggedSphere;
using test::WindowlessPanels;

constexpr VkExtent2D kWindow{320, 200};
constexpr std::uint32_t kPanelWidth = 80;

TEST(PictureSource, WhatShowsTheSameIsKept) {
  EXPECT_EQ(picture_way({.changed = false}), PictureSource::keep);
  EXPECT_EQ(picture_way({.changed = false, .moving = true, .at_rest = true}), PictureSource::keep);
  EXPECT_EQ(picture_way({.changed = false, .is_quick = true}), PictureSource::keep)
      << "it may move on";
}

TEST(PictureSource, WhatMovesIsDrawnFinelyIfThereIsTimeAndElseOnlyAtRest) {
  EXPECT_EQ(picture_way({.moving = true}), PictureSource::fine);
  EXPECT_EQ(picture_way({.moving = true, .fine_is_slow = true}), PictureSource::quick);
  EXPECT_EQ(picture_way({.changed = false, .is_quick = true, .at_rest = true}),
            PictureSource::fine);
  EXPECT_EQ(picture_way({.changed = false, .is_quick = true, .moving = true, .at_rest = true}),
            PictureSource::fine)
      << "a hand that holds still";
}

TEST(PictureSource, WhatChangesAtOnceIsDrawnFinelyUnlessTheEyeJumpsAndThatIsSlow) {
  EXPECT_EQ(picture_way({}), PictureSource::fine);
  EXPECT_EQ(picture_way({.only_view_changed = true}), PictureSource::fine);
  EXPECT_EQ(picture_way({.fine_is_slow = true}), PictureSource::fine);
  EXPECT_EQ(picture_way({.only_view_changed = true, .fine_is_slow = true}), PictureSource::quick);
}

TEST(MovingResolution, FollowsWhatFramesTake) {
  MovingResolution resolution;
  const auto after = [&](int frames, double milliseconds) {
    for (int f = 0; f < frames; ++f) resolution.took(milliseconds);
    return resolution.pixels_per_pixel();
  };
  EXPECT_EQ(after(100, 49.0), 1.0);
  EXPECT_EQ(after(1, 400.0), 1.0) << "one slow frame does not lower the resolution";
  EXPECT_EQ(after(1, 10.0), 1.0);
  EXPECT_EQ(after(2, 60.0), 1.25) << "two thirds of the pixels take 40 ms";
  EXPECT_EQ(after(50, 400.0), MovingResolution::kCoarsest);
  EXPECT_EQ(after(1000, 40.0), MovingResolution::kCoarsest)
      << "a finer resolution would take 52 ms";
  EXPECT_EQ(after(1000, 37.0), 1.75);
  EXPECT_EQ(after(1000, 5.0), 1.0);
}

TEST(MovingResolution, SettlesAtTheFinestThatIsFastEnough) {
  MovingResolution resolution;
  constexpr double kAtFull = 90.0;
  for (int f = 0; f < 1000; ++f) {
    const double pixels = resolution.pixels_per_pixel();
    resolution.took(kAtFull / (pixels * pixels));
  }
  EXPECT_EQ(resolution.pixels_per_pixel(), 1.5);
}

TEST(MovingResolution, TriesFinerLessOftenWhereThatIsTooSlow) {
  MovingResolution resolution;
  int coarse_frames = 0;
  for (int f = 0; f < 1000; ++f) {
    const bool coarse = resolution.pixels_per_pixel() > 1.0;
    coarse_frames += coarse ? 1 : 0;
    resolution.took(coarse ? 20.0 : 60.0);
  }
  EXPECT_GT(coarse_frames, 950);
}

class SceneContentsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    context_ = std::make_shared<gpu::Context>(gpu::ContextOptions{});
    sphere_ = std::make_unique<DraggedSphere>(context_);
    scene_ = sphere_->scene();
    before_.take(scene_);
  }

  bool differs() {
    SceneContents now;
    now.take(scene_);
    return now != before_;
  }
  bool differs_in_view_alone() {
    SceneContents now;
    now.take(scene_);
    return now.differs_in_view_alone(before_);
  }

  std::shared_ptr<gpu::Context> context_;
  std::unique_ptr<DraggedSphere> sphere_;
  Scene scene_;
  SceneContents before_;
};

TEST_F(SceneContentsTest, AreTheSameHoweverTheyAreDrawn) {
  EXPECT_FALSE(differs());
  scene_.moving = true;
  scene_.style.sides = Sides::front;
  EXPECT_FALSE(differs());
}

TEST_F(SceneContentsTest, DifferWhereTheEyeDoes) {
  scene_.camera.eye.x() += 1e-9;
  EXPECT_TRUE(differs());
  EXPECT_TRUE(differs_in_view_alone());
  scene_.style.wireframe = true;
  EXPECT_FALSE(differs_in_view_alone());
}

TEST_F(SceneContentsTest, DifferWhereLooksDo) {
  const auto changed = [&](auto change) {
    scene_ = sphere_->scene();
    change();
    return differs() && !differs_in_view_alone();
  };
  EXPECT_TRUE(changed([&] { scene_.style.flat = true; }));
  EXPECT_TRUE(changed([&] { scene_.style.color = SurfaceColor::regions; }));
  EXPECT_TRUE(changed([&] { scene_.style.range = ScalarRange{0.0F, 1.0F}; }));
  EXPECT_TRUE(changed([&] { scene_.background = Background::white; }));
  EXPECT_TRUE(changed([&] { scene_.grid.emplace(); }));
  EXPECT_TRUE(changed([&] { scene_.left = {scene_.surface, scene_.paint, scene_.style, 100.0}; }));
  EXPECT_TRUE(changed([&] { scene_.surface = nullptr; }));
  EXPECT_TRUE(changed([&] { static_cast<SurfaceScene&>(scene_.beside.emplace()) = scene_; }));
}

TEST_F(SceneContentsTest, DifferOnceTheSurfaceMovesOrAnotherTakesItsPlace) {
  sphere_->drag(0.1);
  EXPECT_TRUE(differs());
  before_.take(scene_);
  const DraggedSphere other(context_);
  scene_.surface = other.scene().surface;
  EXPECT_TRUE(differs());
}

TEST_F(SceneContentsTest, DifferWhereTheSelectionDoes) {
  SurfacePaint paint(sphere_->surface());
  scene_.paint = &paint;
  before_.take(scene_);
  EXPECT_FALSE(differs());
  paint.set_classes(std::vector(sphere_->surface().vertex_count(), VertexClass::roi));
  EXPECT_TRUE(differs());
}

TEST_F(SceneContentsTest, DifferWhereCarriedPointsMove) {
  PointCloud points(context_, Positions{{0.0, 0.0, 0.0}});
  const CarriedDrawing carried{.points = &points};
  scene_.carried = {&carried, 1};
  EXPECT_TRUE(differs());
  before_.take(scene_);
  points.place(Positions{{1.0, 0.0, 0.0}});
  EXPECT_TRUE(differs());
}

// Frames of a window that nobody sees; what moves is drawn with a quarter of the pixels.
class KeptPictureTest : public SceneContentsTest {
 protected:
  void SetUp() override {
    SceneContentsTest::SetUp();
    if (IsSkipped()) return;
    screen_ = std::make_unique<OffscreenScreen>(*context_);
    painter_ =
        std::make_unique<FramePainter>(*context_, *screen_, PaintingOptions{.moving_pixels = 2});
    panels_ = std::make_unique<WindowlessPanels>(kWindow);
    painter_->set_fonts();
    // The panel is not the same in its first frames.
    for (int f = 0; f < 3; ++f) picture();
  }

  Image picture(bool at_rest = true, VkExtent2D size = kWindow) {
    EXPECT_TRUE(painter_->paint(size, scene_, panels_->lay_out(), at_rest));
    painter_->finish_frame(times_);
    return screen_->picture();
  }

  // Draws another image first, so that the cache is invalid. Returns the image drawn after it.
  Image redrawn() {
    const Background before = std::exchange(scene_.background, Background::white);
    picture();
    scene_.background = before;
    return picture();
  }

  std::unique_ptr<OffscreenScreen> screen_;
  std::unique_ptr<FramePainter> painter_;
  std::unique_ptr<WindowlessPanels> panels_;
  FrameTimings times_;
};

TEST_F(KeptPictureTest, APictureThatIsKeptIsTheOneDrawnAnewBitForBit) {
  const Image kept = picture();
  EXPECT_EQ(painter_->way(), PictureSource::keep);
  EXPECT_EQ(redrawn().rgba, kept.rgba);
  EXPECT_EQ(painter_->way(), PictureSource::fine);
}

TEST_F(KeptPictureTest, APanelThatChangesLeavesTheRestOfThePicture) {
  const Image before = picture();
  ImGui::NewFrame();
  ImGui::GetForegroundDrawList()->AddRectFilled({10.0F, 20.0F}, {70.0F, 60.0F}, 0xff0000ff);
  ImGui::Render();
  painter_->paint(kWindow, scene_, *ImGui::GetDrawData());
  painter_->finish_frame(times_);
  EXPECT_EQ(painter_->way(), PictureSource::keep);
  const Image after = screen_->picture();
  EXPECT_NE(after.pixel(40, 40), before.pixel(40, 40));
  for (std::uint32_t y = 0; y < kWindow.height; ++y) {
    for (std::uint32_t x = kPanelWidth; x < kWindow.width; ++x) {
      ASSERT_EQ(after.pixel(x, y), before.pixel(x, y)) << x << ", " << y;
    }
  }
}

TEST_F(KeptPictureTest, AfterACoarseDragTheStillPictureIsTheOneDrawnAnewBitForBit) {
  scene_.moving = true;
  for (int f = 0; f < 3; ++f) {
    scene_.camera.eye.x() += 0.1;
    picture(false);
    EXPECT_EQ(painter_->way(), PictureSource::quick);
    EXPECT_EQ(painter_->picture().pixels_per_pixel(), 2.0);
  }
  const Image moving = picture(false);
  scene_.moving = false;
  EXPECT_EQ(picture(false).rgba, moving.rgba) << "it may move on";
  const Image still = picture(true);
  EXPECT_FALSE(painter_->picture().is_quick());
  EXPECT_EQ(redrawn().rgba, still.rgba);
  EXPECT_NE(still.rgba, moving.rgba);
  EXPECT_LT(lapwing::test::mean_difference(still, moving), 3.0) << "of the same";
}

TEST_F(KeptPictureTest, AnotherSizeIsDrawnAnew) {
  const Image before = picture();
  picture(true, {200, 121});
  EXPECT_EQ(painter_->way(), PictureSource::fine);
  scene_.moving = true;
  scene_.camera.eye.x() += 0.1;
  picture(false, {200, 121});
  EXPECT_EQ(painter_->way(), PictureSource::quick) << "with sides of an odd number of pixels";
  scene_ = sphere_->scene();
  EXPECT_EQ(picture().rgba, before.rgba);
}

}  // namespace
}  // namespace lapwing::viewer
