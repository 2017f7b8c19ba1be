#include "window/main_loop.h"

#include <algorithm>
#include <exception>
#include <imgui.h>
#include <imgui_internal.h>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/gpu/context.h"
#include "window/frame_painter.h"
#include "window/swapchain.h"
#include "window/theme.h"

namespace lapwing::viewer {
namespace {

// ImGui computes the layout with sizes of the last frame, so a change needs this many frames.
constexpr int kFramesPerChange = 3;
// The longest wait for an event, because a desktop may lose an event.
constexpr double kLongestWaitSeconds = 0.5;
// If the scene has not changed for this time, a fine image replaces a quick one.
constexpr double kRestSeconds = 0.15;
// The number of losses of device or surface, without a frame in between, after which the loop ends.
constexpr int kMostLosses = 5;

class MainLoop {
 public:
  MainLoop(Window& window, Graphics& graphics, std::shared_ptr<gpu::Context> context, App& app)
      : window_(window), graphics_(graphics), app_(app), context_(std::move(context)) {
    open_screen();
  }

  void run() {
    while (!app_.wants_to_quit()) {
      try {
        if (device_lost_) reopen_device();
        if (!painter_) open_screen();
        take_turn();
      } catch (const SurfaceLost&) {
        if (++losses_ > kMostLosses) throw;
        close_screen();
      } catch (const GpuError&) {
        // The device is lost or out of memory. It may work again once everything is recreated.
        if (++losses_ > kMostLosses) throw;
        device_lost_ = true;
      }
    }
  }

 private:
  void take_turn() {
    wait_for_work();
    const Stopwatch frame;
    painter_->finish_frame(timings_);
    fit_look();
    fit_title();
    const bool sized = tell_size();
    hand_on_input();
    if (frames_due_ == 0 || !sized) return;
    --frames_due_;
    draw();
    timings_.frame_ms = frame.elapsed_ms();
  }

  void open_screen() {
    screen_ = graphics_.open_screen(*context_);
    painter_.emplace(*context_, *screen_);
    scale_ = 0.0;  // the fonts must be uploaded again
    frames_due_ = kFramesPerChange;
  }

  void close_screen() {
    painter_.reset();
    screen_.reset();
  }

  void reopen_device() {
    close_screen();
    context_ = graphics_.open_device();
    app_.use_device(context_);
    device_lost_ = false;
  }

  void wait_for_work() {
    if (frames_due_ > 0) {
      window_.poll();
    } else {
      window_.wait(painter_->picture().is_quick()
                       ? std::clamp(kRestSeconds - still_seconds(), 0.001, kLongestWaitSeconds)
                       : kLongestWaitSeconds);
      if (painter_->picture().is_quick() && still_seconds() >= kRestSeconds) frames_due_ = 1;
    }
    const VkExtent2D now = window_.pixels();
    const bool resized = now.width != pixels_.width || now.height != pixels_.height;
    if (window_.take_changed() || resized) frames_due_ = kFramesPerChange;
  }

  /// Returns the time since the scene changed.
  double still_seconds() const { return 1e-3 * since_change_.elapsed_ms(); }

  void fit_look() {
    const double scale = window_.content_scale();
    const Theme theme = app_.theme();
    if (scale == scale_ && theme == theme_) return;
    if (scale != scale_) {
      set_fonts(scale);
      painter_->set_fonts();
      pixels_ = {};  // so that `tell_size` passes the new scale to the app
    }
    scale_ = scale;
    theme_ = theme;
    set_theme(theme, scale);
  }

  void fit_title() {
    if (const std::string_view title = app_.title(); title != title_) {
      title_ = title;
      window_.set_title(title_);
    }
  }

  // Reports a new window size to the app. Returns false while the window is minimized.
  bool tell_size() {
    const VkExtent2D now = window_.pixels();
    if (now.width == 0 || now.height == 0) {
      window_.wait(kLongestWaitSeconds);
      return false;
    }
    if (now.width != pixels_.width || now.height != pixels_.height) {
      pixels_ = now;
      app_.resize({now.width, now.height}, scale_);
    }
    return true;
  }

  // Passes the events to panels and app in order. Before an event that the panels could not
  // distinguish from earlier events, lays the panels out, which takes a small part of a frame. If
  // an event throws a GpuError, the later events wait for the next turn.
  void hand_on_input() {
    if (window_.take_close_request()) app_.ask_to_close();
    while (window_.has_input()) {
      if (!window_.panels().fits(window_.next_input())) lay_out_panels();
      const auto event = window_.hand_on();
      if (event && app_.handle(*event)) frames_due_ = kFramesPerChange;
    }
    if (window_.take_changed()) frames_due_ = kFramesPerChange;
    for (const std::filesystem::path& file : window_.take_dropped_files()) app_.open(file);
  }

  // Lays the panels out until the keyboard focus is known.
  void lay_out_panels() {
    for (int k = 0; k < kFramesPerChange; ++k) {
      lay_out();
      if (!window_.panels().focus_is_pending()) return;
    }
  }

  void lay_out() {
    window_.panels().new_frame();
    ImGui::NewFrame();
    try {
      app_.draw_ui(timings_);
    } catch (...) {
      // ImGui must end this frame before the next one begins.
      ImGui::ErrorCheckEndFrameRecover(nullptr);
      ImGui::EndFrame();
      throw;
    }
    ImGui::Render();
    window_.panels().laid_out();
  }

  void draw() {
    const Stopwatch panels;
    lay_out();
    timings_.panels_ms = panels.elapsed_ms();
    const bool at_rest = still_seconds() >= kRestSeconds;
    const bool shown = painter_->paint(pixels_, app_.scene(), *ImGui::GetDrawData(), at_rest);
    if (painter_->way() != PictureSource::keep) since_change_.restart();
    if (shown) {
      losses_ = 0;
    } else {
      frames_due_ = kFramesPerChange;
    }
  }

  Window& window_;
  Graphics& graphics_;
  App& app_;
  std::shared_ptr<gpu::Context> context_;
  std::unique_ptr<Screen> screen_;
  std::optional<FramePainter> painter_;
  bool device_lost_ = false;
  int losses_ = 0;  // losses of device or surface since the last frame
  FrameTimings timings_;
  VkExtent2D pixels_{};
  double scale_ = 0.0;
  Theme theme_ = Theme::dark;
  std::string title_;
  Stopwatch since_change_;  // started at the last change of the scene
  int frames_due_ = kFramesPerChange;
};

}  // namespace

WindowGraphics::WindowGraphics(const Window& window, std::string device)
    : window_(window), device_(std::move(device)) {}

std::shared_ptr<gpu::Context> WindowGraphics::open_device() {
  std::exception_ptr failure;
  try {
    auto context = open(device_);
    was_open_ = true;
    return context;
  } catch (const GpuError&) {
    if (!was_open_) throw;
    failure = std::current_exception();
  }
  for (const gpu::DeviceDescription& device : gpu::list_devices()) {
    if (!device.rejected.empty()) continue;
    try {
      return open(std::to_string(device.index));
    } catch (const GpuError&) {
      continue;  // if no device can be opened, the error of the requested device is thrown
    }
  }
  std::rethrow_exception(failure);
}

std::shared_ptr<gpu::Context> WindowGraphics::open(const std::string& device) const {
  gpu::ContextOptions options;
  options.device = device;
  options.instance_extensions = window_.instance_extensions();
  options.device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  return std::make_shared<gpu::Context>(options);
}

std::unique_ptr<Screen> WindowGraphics::open_screen(gpu::Context& context) {
  return std::make_unique<Swapchain>(context, window_);
}

void run_main_loop(Window& window, Graphics& graphics, std::shared_ptr<gpu::Context> context,
                   App& app) {
  MainLoop(window, graphics, std::move(context), app).run();
}

}  // namespace lapwing::viewer
