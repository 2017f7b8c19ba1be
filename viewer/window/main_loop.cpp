#include "window/main_loop.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#include <string>
#include <utility>

#include "lapwing/base/stopwatch.h"
#include "lapwing/gpu/context.h"
#include "window/frame_painter.h"
#include "window/theme.h"

namespace lapwing::viewer {
namespace {

// ImGui lays out from what the last frame knew: a change is settled after this many.
constexpr int kFramesPerChange = 3;
// A desktop may lose an event; the window then looks again after so long.
constexpr double kLongestWaitSeconds = 0.5;

class Surface {
 public:
  Surface(const Window& window, const gpu::Context& context)
      : instance_(context.instance()), handle_(window.create_surface(instance_)) {}
  ~Surface() { vkDestroySurfaceKHR(instance_, handle_, nullptr); }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;
  VkSurfaceKHR handle() const { return handle_; }

 private:
  VkInstance instance_;
  VkSurfaceKHR handle_;
};

class MainLoop {
 public:
  MainLoop(Window& window, gpu::Context& context, App& app)
      : window_(window),
        app_(app),
        surface_(window, context),
        painter_(context, surface_.handle()) {}

  void run() {
    while (!app_.wants_to_quit()) {
      wait_for_work();
      const Stopwatch frame;
      painter_.finish_frame(timings_);
      fit_fonts();
      fit_title();
      const bool sized = tell_size();
      hand_on_input();
      if (frames_due_ == 0 || !sized) continue;
      --frames_due_;
      draw();
      timings_.frame_ms = frame.elapsed_ms();
    }
  }

 private:
  void wait_for_work() {
    if (frames_due_ > 0) {
      window_.poll();
    } else {
      window_.wait(kLongestWaitSeconds);
    }
    const VkExtent2D now = window_.pixels();
    const bool resized = now.width != pixels_.width || now.height != pixels_.height;
    if (window_.take_changed() || resized) frames_due_ = kFramesPerChange;
  }

  void fit_fonts() {
    const double scale = window_.content_scale();
    if (scale == scale_) return;
    scale_ = scale;
    set_theme(scale);
    painter_.set_fonts();
  }

  void fit_title() {
    if (std::string title = app_.title(); title != title_) {
      title_ = std::move(title);
      window_.set_title(title_);
    }
  }

  // False while there is nothing to draw into: the window is minimized.
  bool tell_size() {
    const VkExtent2D now = window_.pixels();
    if (now.width == 0 || now.height == 0) {
      window_.wait(kLongestWaitSeconds);
      return false;
    }
    if (now.width != pixels_.width || now.height != pixels_.height) {
      pixels_ = now;
      app_.resize({now.width, now.height});
    }
    return true;
  }

  void hand_on_input() {
    if (window_.take_close_request()) app_.ask_to_close();
    for (const InputEvent& event : window_.take_events()) {
      if (app_.handle(event)) frames_due_ = kFramesPerChange;
    }
    for (const std::filesystem::path& file : window_.take_dropped_files()) app_.open(file);
  }

  void draw() {
    const Stopwatch panels;
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    app_.draw_ui(timings_);
    ImGui::Render();
    timings_.panels_ms = panels.elapsed_ms();
    // A window that changed while it was drawn is drawn again.
    if (!painter_.paint(pixels_, app_.scene(), *ImGui::GetDrawData())) {
      frames_due_ = kFramesPerChange;
    }
  }

  Window& window_;
  App& app_;
  Surface surface_;
  FramePainter painter_;
  FrameTimings timings_;
  VkExtent2D pixels_{};
  double scale_ = 0.0;
  std::string title_;
  int frames_due_ = kFramesPerChange;
};

}  // namespace

void run_main_loop(Window& window, gpu::Context& context, App& app) {
  MainLoop(window, context, app).run();
}

}  // namespace lapwing::viewer
