#include "window/frame_painter.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/gpu/context.h"
#include "support/failing_new.h"
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
  void drag_and_paint(double distance) {
    sphere.drag(distance);
    paint(moving_scene);
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
  frames.painter.forget_picture();
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
  frames.drag_and_paint(0.3);
  EXPECT_THAT((std::vector{frames.times.blend_ms, frames.times.normals_ms, frames.times.draw_ms,
                           frames.times.ui_ms}),
              Each(Gt(0.0)));
  frames.paint(frames.sphere.scene());
  EXPECT_EQ(frames.times.blend_ms, 0.0) << "nothing was dragged in this frame";
  EXPECT_EQ(frames.times.normals_ms, 0.0);
  EXPECT_GT(frames.times.draw_ms, 0.0);
}

TEST(FramePainter, DragFramesAllocateNothing) {
  LAPWING_NEEDS_GPU();
  const test::WithoutValidation without_validation;
  Frames frames;
  for (int f = 0; f < 3; ++f) frames.drag_and_paint(0.1 * f);
  long calls = 0;
  {
    const lapwing::test::FailingNew counting(-1);
    for (int f = 0; f < 10; ++f) frames.drag_and_paint(0.1 * f);
    calls = lapwing::test::FailingNew::calls();
  }
  EXPECT_EQ(calls, 0);
}

TEST(FramePainter, PaintsNothingInAWindowWithoutSize) {
  LAPWING_NEEDS_GPU();
  Frames frames;
  EXPECT_TRUE(frames.paint(frames.sphere.scene()));
  EXPECT_FALSE(frames.painter.paint({0, 0}, frames.sphere.scene(), frames.panels.lay_out()));
  frames.painter.finish_frame(frames.times);
  EXPECT_TRUE(frames.paint(frames.sphere.scene())) << "the window is back";
}

// Every buffer that commands of a context are recorded to bind, and the copies among them: what the
// device is told, whatever the layers above say.
class CommandSpy {
 public:
  explicit CommandSpy(gpu::Context& context) : table_(const_cast<VolkDeviceTable&>(context.vk())) {
    real_ = table_;
    bound.clear();
    copies = 0;
    table_.vkCmdPushDescriptorSetKHR = push;
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
  ~CommandSpy() { table_ = real_; }
  CommandSpy(const CommandSpy&) = delete;
  CommandSpy& operator=(const CommandSpy&) = delete;

  struct Bound {
    VkPipelineBindPoint point;
    std::vector<VkBuffer> buffers;
  };
  static inline std::vector<Bound> bound;
  static inline int copies = 0;

 private:
  static void VKAPI_PTR push(VkCommandBuffer commands, VkPipelineBindPoint point,
                             VkPipelineLayout layout, std::uint32_t set, std::uint32_t count,
                             const VkWriteDescriptorSet* writes) {
    bound.push_back({point, {}});
    for (std::uint32_t w = 0; w < count; ++w) {
      bound.back().buffers.push_back(writes[w].pBufferInfo->buffer);
    }
    real_.vkCmdPushDescriptorSetKHR(commands, point, layout, set, count, writes);
  }

  static inline VolkDeviceTable real_;
  VolkDeviceTable& table_;
};

TEST(FramePainter, DrawsFromTheVeryBuffersThatTheKernelsWrote) {
  LAPWING_NEEDS_GPU();
  // Kernels write on any device where memory is not mapped.
  Frames frames({.map_device_memory = false});
  const CommandSpy spy(*frames.context);
  DraggedSphere sphere(frames.context);
  CommandSpy::bound.clear();
  sphere.drag(0.1);
  EXPECT_TRUE(CommandSpy::bound.empty()) << "it moves in the submission that draws it";
  frames.paint(sphere.scene());
  // Blend and normals both bind five buffers and write the last one.
  std::vector<VkBuffer> written;
  for (const CommandSpy::Bound& bound : CommandSpy::bound) {
    if (bound.point == VK_PIPELINE_BIND_POINT_COMPUTE) written.push_back(bound.buffers.at(4));
  }
  EXPECT_EQ(written.size(), 2U);
  const auto drawn = std::find_if(
      CommandSpy::bound.begin(), CommandSpy::bound.end(), [](const CommandSpy::Bound& bound) {
        return bound.point == VK_PIPELINE_BIND_POINT_GRAPHICS && bound.buffers.size() == 10;
      });
  ASSERT_NE(drawn, CommandSpy::bound.end());
  const VkBuffer positions = drawn->buffers[0];
  const VkBuffer normals = drawn->buffers[1];
  EXPECT_NE(positions, normals);
  EXPECT_THAT(written, ::testing::Contains(positions));
  EXPECT_THAT(written, ::testing::Contains(normals));
}

TEST(FramePainter, DragMovesNoVertexDataBetweenHostAndDevice) {
  LAPWING_NEEDS_GPU();
  // As on a graphics card: what the device alone keeps, the host could reach only by copies.
  Frames frames({.map_device_memory = false});
  ASSERT_TRUE(frames.sphere.surface().position_buffer().mapped().empty());
  ASSERT_TRUE(frames.sphere.surface().normal_buffer().mapped().empty());
  const CommandSpy spy(*frames.context);
  const gpu::TransferCounts before = frames.context->transfers();
  constexpr std::size_t kFrames = 5;
  const ImDrawData no_panels;
  for (std::size_t f = 0; f < kFrames; ++f) {
    frames.sphere.drag(0.1 * static_cast<double>(f + 1));
    frames.painter.paint(kSize, frames.moving_scene, no_panels);
    frames.painter.finish_frame(frames.times);
  }
  const gpu::TransferCounts after = frames.context->transfers();
  EXPECT_EQ(CommandSpy::copies, 0);
  EXPECT_EQ(after.downloaded, before.downloaded);
  // The motion of one handle: twelve numbers, and which columns they are of.
  EXPECT_LE(after.uploaded - before.uploaded, kFrames * 128);
  EXPECT_GT(after.uploaded, before.uploaded);
}

}  // namespace
}  // namespace lapwing::viewer
