#pragma once

#include <optional>

#include "lapwing/gpu/command_list.h"
#include "lapwing/render/surface.h"
#include "window/app.h"
#include "window/kept_picture.h"
#include "window/screen.h"
#include "window/ui_renderer.h"

namespace lapwing::viewer {

/// Draws frames on a screen, one at a time: the picture of the scene, which is kept from one frame
/// to the next (KeptPicture), and panels over it. Allocates nothing from one
/// frame of a size to the next. The context and the screen must outlive it.
class FramePainter {
 public:
  FramePainter(gpu::Context& context, Screen& screen, const PaintingOptions& options = {});
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
  /// one, another frame is needed. Throws SurfaceLost and gpu::DeviceLost, after which only the
  /// destructor may be called. `at_rest`: nothing in the scene has changed for a while, and what
  /// was drawn quickly is drawn finely.
  bool paint(VkExtent2D pixels, const Scene& scene, const ImDrawData& panels, bool at_rest = true);

  /// What the last frame did about the picture.
  PictureWay way() const { return way_; }
  const KeptPicture& picture() const { return picture_; }
  /// The next frame draws its picture anew.
  void forget_picture() { picture_.forget(); }

 private:
  void fit_to(VkExtent2D pixels);
  void record(const Screen::Image& image, const Scene& scene, const ImDrawData& panels);
  void submit(const Screen::Image& image);

  gpu::Context& context_;
  Screen& screen_;
  KeptPicture picture_;
  PictureWay way_ = PictureWay::keep;
  UiRenderer ui_;
  gpu::CommandList commands_;
  VkExtent2D fitted_{};  ///< the window that the screen's images were made for
  bool outdated_ = true;
  std::optional<SurfaceTimes> painted_;  ///< of a frame submitted since `finish_frame`
  bool moved_ = false;                   ///< whether kernels of that moved the surface
};

}  // namespace lapwing::viewer
