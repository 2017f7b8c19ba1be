#include "window/frame_painter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/gpu/context.h"
#include "support/gpu.h"
#include "viewer_window/desktop.h"
#include "viewer_window/test_frames.h"
#include "window/offscreen_screen.h"
#include "window/ui_renderer.h"

namespace lapwing::viewer {
namespace {

using lapwing::test::mean_difference;
using test::DraggedSphere;
using test::WindowlessPanels;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::Gt;
using ::testing::Le;

constexpr VkExtent2D kSize{320, 200};
constexpr std::uint32_t kCenterX = kSize.width / 2;
constexpr std::uint32_t kCenterY = kSize.height / 2;

// What a window's frames are made of, without the window.
struct Frames {
  explicit Frames(const gpu::ContextOptions& options = {})
      : context(std::make_shared<gpu::Context>(options)),
        sphere(context),
        screen(*context),
        painter(*context, screen),
        panels(kSize),
        moving_scene(sphere.scene()) {
    painter.set_fonts();
    moving_scene.moving = true;
  }

  bool paint(const Scene& scene) {
    const bool shown = painter.paint(kSize, scene, panels.lay_out());
    painter.finish_frame(times);
    return shown;
  }
  Image picture_of(const Scene& scene) {
    paint(scene);
    return screen.picture();
  }

  std::shared_ptr<gpu::Context> context;
  DraggedSphere sphere;
  OffscreenScreen screen;
  FramePainter painter;
  WindowlessPanels panels;
  Scene moving_scene;
  FrameTimings times;
};

TEST(FramePainter, PaintsTheSurfaceAndThePanelsOverIt) {
  LAPWING_NEEDS_GPU();
  Frames frames;
  const Image picture = frames.picture_of(frames.sphere.scene());
  const auto clay = picture.pixel(kCenterX, kCenterY);
  const auto background = picture.pixel(kSize.width - 2, 2);
  const auto panel = picture.pixel(40, 90);
  EXPECT_GT(clay[0], clay[2]) << "warm";
  EXPECT_THAT(background, Each(Gt(200)));
  EXPECT_THAT(std::vector(panel.begin(), panel.begin() + 3), Each(Le(60)));
}

TEST(FramePainter, ShowsAPictureInItsColoursAndNothingWhereItIsClear) {
  LAPWING_NEEDS_GPU();
  Frames frames;
  const Image without = frames.picture_of({});
  const UiPicture halves(*frames.context, {2, 1, {200, 100, 50, 255, 0, 0, 0, 0}});
  ImGui::NewFrame();
  ImGui::GetForegroundDrawList()->AddImage(halves.id(), {200.0F, 20.0F}, {280.0F, 60.0F});
  ImGui::Render();
  frames.painter.paint(kSize, {}, *ImGui::GetDrawData());
  frames.painter.finish_frame(frames.times);
  const Image with = frames.screen.picture();
  const auto left = with.pixel(210, 40);
  EXPECT_NEAR(left[0], 200, 1);
  EXPECT_NEAR(left[1], 100, 1);
  EXPECT_NEAR(left[2], 50, 1);
  EXPECT_EQ(with.pixel(275, 40), without.pixel(275, 40));
}

TEST(FramePainter, WhatMovesLooksTheSameButForItsEdges) {
  LAPWING_NEEDS_GPU();
  Frames frames;
  Scene scene = frames.sphere.scene();
  const Image still = frames.picture_of(scene);
  frames.picture_of({});  // so that the surface is drawn again
  scene.moving = true;
  scene.style.sides = Sides::front;
  const Image moving = frames.picture_of(scene);
  EXPECT_THAT(mean_difference(moving, still), AllOf(Gt(0.0), Le(0.5)));
  EXPECT_EQ(moving.pixel(kCenterX, kCenterY), still.pixel(kCenterX, kCenterY));
}

TEST(FramePainter, ASecondSurfaceIsDrawnInItsPartAndNowhereElse) {
  LAPWING_NEEDS_GPU();
  Frames frames;
  Scene scene = frames.sphere.scene();
  const Image alone = frames.picture_of(scene);
  SideScene& beside = scene.beside.emplace();
  static_cast<SurfaceScene&>(beside) = frames.sphere.scene();
  beside.corner = {200.0, 50.0};
  beside.size = {120.0, 100.0};
  const Image both = frames.picture_of(scene);
  constexpr std::uint32_t kPanel = 80;  // at the left, and not the same in its first frames
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(both.pixel(260, 100)[c], alone.pixel(kCenterX, kCenterY)[c], 4) << "its middle";
  }
  EXPECT_THAT(both.pixel(204, 100), Each(Gt(200))) << "background where the other surface was";
  for (std::uint32_t y = 0; y < kSize.height; ++y) {
    for (std::uint32_t x = kPanel; x < kSize.width; ++x) {
      if (x >= 200 && y >= 50 && y < 150) continue;
      ASSERT_EQ(both.pixel(x, y), alone.pixel(x, y)) << x << ", " << y;
    }
  }
}

TEST(FramePainter, TimesEveryPartOfADragFrame) {
  LAPWING_NEEDS_GPU();
  Frames frames;
  if (frames.context->limits().timestampComputeAndGraphics == VK_FALSE) {
    GTEST_SKIP() << "a device without timestamps";
  }
  frames.sphere.drag(0.3);
  frames.paint(frames.moving_scene);
  EXPECT_THAT((std::vector{frames.times.blend_ms, frames.times.normals_ms, frames.times.draw_ms,
                           frames.times.ui_ms}),
              Each(Gt(0.0)));
  frames.paint(frames.sphere.scene());
  EXPECT_EQ(frames.times.blend_ms, 0.0) << "nothing was dragged in this frame";
  EXPECT_EQ(frames.times.normals_ms, 0.0);
  EXPECT_GT(frames.times.draw_ms, 0.0);
}

TEST(FramePainter, PaintsNothingInAWindowWithoutSize) {
  LAPWING_NEEDS_GPU();
  Frames frames;
  EXPECT_TRUE(frames.paint(frames.sphere.scene()));
  EXPECT_FALSE(frames.painter.paint({0, 0}, frames.sphere.scene(), frames.panels.lay_out()));
  frames.painter.finish_frame(frames.times);
  EXPECT_TRUE(frames.paint(frames.sphere.scene())) << "the window is back";
}

// Counts the copies in the commands that are recorded on a context.
class CopyCounter {
 public:
  explicit CopyCounter(gpu::Context& context) : table_(const_cast<VolkDeviceTable&>(context.vk())) {
    real_ = table_;
    copies = 0;
    table_.vkCmdCopyBuffer = [](VkCommandBuffer commands, VkBuffer from, VkBuffer to,
                                std::uint32_t count, const VkBufferCopy* regions) {
      ++copies;
      real_.vkCmdCopyBuffer(commands, from, to, count, regions);
    };
    table_.vkCmdUpdateBuffer = [](VkCommandBuffer commands, VkBuffer to, VkDeviceSize offset,
                                  VkDeviceSize bytes, const void* data) {
      ++copies;
      real_.vkCmdUpdateBuffer(commands, to, offset, bytes, data);
    };
  }
  ~CopyCounter() { table_ = real_; }
  CopyCounter(const CopyCounter&) = delete;
  CopyCounter& operator=(const CopyCounter&) = delete;

  static inline int copies = 0;

 private:
  static inline VolkDeviceTable real_;
  VolkDeviceTable& table_;
};

TEST(FramePainter, DragMovesNoVertexDataBetweenHostAndDevice) {
  LAPWING_NEEDS_GPU();
  // As on a graphics card: what the device alone keeps, the host could reach only by copies.
  Frames frames({.map_device_memory = false});
  ASSERT_TRUE(frames.sphere.surface().position_buffer().mapped().empty());
  ASSERT_TRUE(frames.sphere.surface().normal_buffer().mapped().empty());
  const CopyCounter counter(*frames.context);
  const gpu::TransferCounts before = frames.context->transfers();
  constexpr std::size_t kFrames = 5;
  const ImDrawData no_panels;
  for (std::size_t f = 0; f < kFrames; ++f) {
    frames.sphere.drag(0.1 * static_cast<double>(f + 1));
    frames.painter.paint(kSize, frames.moving_scene, no_panels);
    frames.painter.finish_frame(frames.times);
  }
  const gpu::TransferCounts after = frames.context->transfers();
  EXPECT_EQ(CopyCounter::copies, 0);
  EXPECT_EQ(after.downloaded, before.downloaded);
  // The motion of one handle: twelve numbers, and which columns they are of.
  EXPECT_LE(after.uploaded - before.uploaded, kFrames * 128);
  EXPECT_GT(after.uploaded, before.uploaded);
}

}  // namespace
}  // namespace lapwing::viewer
