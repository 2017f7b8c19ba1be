#pragma once

#include <memory>

#include "window/app.h"
#include "window/screen.h"
#include "window/window.h"

namespace lapwing::viewer {

/// Opens the device and the screen for frames, at the start and again after a loss.
class Graphics {
 public:
  virtual ~Graphics() = default;
  /// Both throw GpuError if there is none.
  virtual std::shared_ptr<gpu::Context> open_device() = 0;
  virtual std::unique_ptr<Screen> open_screen(gpu::Context& context) = 0;
};

/// The graphics of a window.
class WindowGraphics final : public Graphics {
 public:
  /// `device` as in gpu::ContextOptions. If it was open and cannot be reopened, another one is
  /// used. The window must outlive this.
  WindowGraphics(const Window& window, std::string device);
  std::shared_ptr<gpu::Context> open_device() override;
  std::unique_ptr<Screen> open_screen(gpu::Context& context) override;

 private:
  std::shared_ptr<gpu::Context> open(const std::string& device) const;

  const Window& window_;
  std::string device_;
  bool was_open_ = false;
};

/// Runs `app` in `window` until the user or the app quits. Draws only after events, so an idle
/// window uses no CPU time. `context` must come from `graphics` and be the one that `app` uses.
/// Recreates the swapchain if it is lost. Recreates the device if it is lost or out of memory
/// (`App::use_device`). Throws GpuError if the device cannot draw into the window, or if recreation
/// fails repeatedly.
void run_main_loop(Window& window, Graphics& graphics, std::shared_ptr<gpu::Context> context,
                   App& app);

}  // namespace lapwing::viewer
