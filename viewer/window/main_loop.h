#pragma once

#include <memory>

#include "window/app.h"
#include "window/screen.h"
#include "window/window.h"

namespace lapwing::viewer {

/// Opens the device and the screen at the start, and again after one of them was lost.
class Graphics {
 public:
  virtual ~Graphics() = default;
  /// Both functions throw GpuError if they fail.
  virtual std::shared_ptr<gpu::Context> open_device() = 0;
  virtual std::unique_ptr<Screen> open_screen(gpu::Context& context) = 0;
};

/// The graphics of a window.
class WindowGraphics final : public Graphics {
 public:
  /// `device` selects the device, as in gpu::ContextOptions. If a device is lost and cannot be
  /// reopened, another device is used. The window must outlive this object.
  WindowGraphics(const Window& window, std::string device);
  std::shared_ptr<gpu::Context> open_device() override;
  std::unique_ptr<Screen> open_screen(gpu::Context& context) override;

 private:
  std::shared_ptr<gpu::Context> open(const std::string& device) const;

  const Window& window_;
  std::string device_;
  bool was_open_ = false;
};

/// Runs `app` in `window` until the app quits. Draws only after events, so an idle window uses no
/// CPU time. `context` must be opened by `graphics` and used by `app`. Recreates the swapchain if
/// it is lost. Recreates the device if it is lost or out of memory (`App::use_device`). Throws
/// GpuError if the device cannot draw into the window, or if recreation fails repeatedly.
void run_main_loop(Window& window, Graphics& graphics, std::shared_ptr<gpu::Context> context,
                   App& app);

}  // namespace lapwing::viewer
