#pragma once

#include <optional>

#include "lapwing/gpu/command_list.h"
#include "lapwing/render/draw_scope.h"
#include "lapwing/render/renderer.h"
#include "window/app.h"
#include "window/swapchain.h"
#include "window/ui_renderer.h"

namespace lapwing::viewer {

/// Draws a window's frames, one at a time: surface antialiased, panels over it. The context and the
/// surface must outlive it.
class FramePainter {
 public:
  FramePainter(gpu::Context& context, VkSurfaceKHR surface);
  ~FramePainter();
  FramePainter(const FramePainter&) = delete;
  FramePainter& operator=(const FramePainter&) = delete;

  /// Waits for the last frame: then whatever it drew may be changed. Puts its times on the device
  /// into `timings`.
  void finish_frame(FrameTimings& timings);

  /// Takes over the fonts of ImGui. After `finish_frame`.
  void set_fonts() { ui_.set_fonts(); }

  /// Draws one frame of a window of `pixels` and hands it to the screen, after `finish_frame`.
  /// False where it could not be shown because the window changed or has no size: if it still has
  /// one, another frame is needed.
  bool paint(VkExtent2D pixels, const Scene& scene, const ImDrawData& panels);

 private:
  void fit_to(VkExtent2D pixels);
  void record(const Swapchain::Image& image, const Scene& scene, const ImDrawData& panels);

  gpu::Context& context_;
  Swapchain swapchain_;
  TargetFormat format_;
  Renderer renderer_;
  UiRenderer ui_;
  gpu::CommandList commands_;
  std::optional<DrawScope> scope_;  ///< of the swapchain's size
  VkSemaphore ready_ = VK_NULL_HANDLE;
  VkExtent2D fitted_{};  ///< the window that the swapchain was made for
  bool outdated_ = true;
  bool timed_ = false;  ///< a frame has been submitted since `finish_frame`
};

}  // namespace lapwing::viewer
