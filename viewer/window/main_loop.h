#pragma once

#include <memory>

#include "window/app.h"
#include "window/screen.h"
#include "window/window.h"

namespace lapwing::viewer {

/// What frames are drawn with: opened at the start, and again when it is lost.
class Graphics {
 public:
  virtual ~Graphics() = default;
  /// Both throw GpuError when there is none.
  virtual std::shared_ptr<gpu::Context> open_device() = 0;
  virtual std::unique_ptr<Screen> open_screen(gpu::Context& context) = 0;
};

/// A window's.
class WindowGraphics final : public Graphics {
 public:
  /// `device` as in gpu::ContextOptions. Where it was open and cannot be opened again, another one
  /// is. The window must outlive it.
  WindowGraphics(const Window& window, std::string device);
  std::shared_ptr<gpu::Context> open_device() override;
  std::unique_ptr<Screen> open_screen(gpu::Context& context) override;

 private:
  std::shared_ptr<gpu::Context> open(const std::string& device) const;

  const Window& window_;
  std::string device_;
  bool was_open_ = false;
};

/// Shows `app` in `window` until the person or the app quits. Draws only when something happened:
/// an idle window takes no time. `context`, which `app` uses too, is of `graphics`.
///
/// A screen that is lost is opened again, and so is a device that is lost or out of memory, which
/// `App::use_device` is then told. Throws GpuError when the device cannot draw into the window, and
/// when screen or device fail again and again without a frame between.
void run_main_loop(Window& window, Graphics& graphics, std::shared_ptr<gpu::Context> context,
                   App& app);

}  // namespace lapwing::viewer
