#pragma once

#include <optional>

#include "lapwing/gpu/command_list.h"
#include "lapwing/render/surface.h"
#include "window/app.h"
#include "window/cached_picture.h"
#include "window/screen.h"
#include "window/ui_renderer.h"

namespace lapwing::viewer {

/// Draws frames on a screen, one at a time: the picture of the scene, which stays from frame to
/// frame (CachedPicture), and panels over it. Allocates nothing while the size stays the same. The
/// context and the screen must outlive it.
class FramePainter {
 public:
  FramePainter(gpu::Context& context, Screen& screen, const PaintingOptions& options = {});
  ~FramePainter();
  FramePainter(const FramePainter&) = delete;
  FramePainter& operator=(const FramePainter&) = delete;

  /// Waits for the last frame, so that what it drew may change. Writes its times on the device to
  /// `timings`.
  void finish_frame(FrameTimings& timings);

  /// Uploads the fonts of ImGui. Call `finish_frame` first.
  void set_fonts() { ui_.set_fonts(); }

  /// Draws one frame of a window of `pixels` and shows it. Call `finish_frame` first. Returns false
  /// if the window changed or has no size; if it has one, another frame is needed. `at_rest`: the
  /// scene has not changed for a while, so a quickly drawn picture is drawn finely. Throws
  /// SurfaceLost and gpu::DeviceLost, after which only the destructor may be called.
  bool paint(VkExtent2D pixels, const Scene& scene, const ImDrawData& panels, bool at_rest = true);

  /// How the last frame got its picture.
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
  VkExtent2D fitted_{};  ///< window size that the screen's images fit
  bool outdated_ = true;
  std::optional<SurfaceTimes> painted_;  ///< times of a frame submitted since `finish_frame`
  bool moved_ = false;                   ///< whether kernels of that frame moved the surface
};

}  // namespace lapwing::viewer
