#pragma once

#include <optional>

#include "lapwing/gpu/command_list.h"
#include "lapwing/render/surface.h"
#include "window/app.h"
#include "window/cached_picture.h"
#include "window/screen.h"
#include "window/ui_renderer.h"

namespace lapwing::viewer {

/// Draws frames on a screen, one at a time: the cached image of the scene (CachedPicture), and the
/// panels over it. Allocates memory only if the size changes. The context and the screen must
/// outlive it.
class FramePainter {
 public:
  FramePainter(gpu::Context& context, Screen& screen, const PaintingOptions& options = {});
  ~FramePainter();
  FramePainter(const FramePainter&) = delete;
  FramePainter& operator=(const FramePainter&) = delete;

  /// Waits until the device has drawn the last frame, so that its data may change. Writes the
  /// device times of this frame to `timings`.
  void finish_frame(FrameTimings& timings);

  /// Uploads the fonts of ImGui. Call `finish_frame` first.
  void set_fonts() { ui_.set_fonts(); }

  /// Draws and presents one frame for a window of size `pixels`. Call `finish_frame` first. Returns
  /// false if the window has changed, and another frame is needed, or if its size is 0. If
  /// `at_rest` is true, a fine image replaces a quick one. Throws SurfaceLost and gpu::DeviceLost,
  /// after which only the destructor may be called.
  bool paint(VkExtent2D pixels, const Scene& scene, const ImDrawData& panels, bool at_rest = true);

  /// Returns the source of the image in the last frame.
  PictureSource way() const { return way_; }
  const CachedPicture& picture() const { return picture_; }

 private:
  void fit_to(VkExtent2D pixels);
  void record(const Screen::Image& image, const Scene& scene, const ImDrawData& panels);
  void submit(const Screen::Image& image);

  gpu::Context& context_;
  Screen& screen_;
  CachedPicture picture_;
  PictureSource way_ = PictureSource::keep;
  UiRenderer ui_;
  gpu::CommandList commands_;
  VkExtent2D fitted_{};  ///< window size for which the screen's images were created
  bool outdated_ = true;
  std::optional<SurfaceTimes> painted_;  ///< set if a frame was submitted after `finish_frame`
  bool moved_ = false;                   ///< whether kernels of this frame moved the surface
};

}  // namespace lapwing::viewer
