#include "studies/viewer_frames.h"

#include <chrono>
#include <imgui.h>
#include <thread>

#include "lapwing/gpu/context.h"
#include "run/temporary_mesh.h"
#include "studies/frame_parts.h"
#include "ui/viewer_app.h"
#include "window/frame_painter.h"
#include "window/offscreen_screen.h"
#include "window/theme.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector2d;
using viewer::InputKind;
using viewer::MouseButton;

// The viewer with its default panels. It saves no settings.
class WholeViewer {
 public:
  WholeViewer(const FrameBench& settings, const std::filesystem::path& mesh)
      : size_{settings.width, settings.height},
        context_(open(settings.device)),
        screen_(*context_),
        painter_(*context_, screen_),
        app_(context_, {}) {
    ImGui::CreateContext();
    viewer::set_fonts(1.0);
    viewer::set_theme(viewer::Theme::dark, 1.0);
    painter_.set_fonts();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {static_cast<float>(size_.width), static_cast<float>(size_.height)};
    io.DeltaTime = 1.0F / 60.0F;
    app_.resize({size_.width, size_.height}, 1.0);
    app_.open(mesh);
    FrameParts uncounted;
    while (app_.scene().surface == nullptr) {
      draw(uncounted);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    // Let other work that opening started come to an end.
    for (int k = 0; k < kFramesPerRun; ++k) draw(uncounted);
  }
  ~WholeViewer() { ImGui::DestroyContext(); }
  WholeViewer(const WholeViewer&) = delete;
  WholeViewer& operator=(const WholeViewer&) = delete;

  // Moves the cursor down over the controls of the sidebar.
  void point_at_panels(int frame, FrameParts& parts) {
    const float down = 60.0F + 30.0F * static_cast<float>(frame % kFramesPerRun);
    ImGui::GetIO().MousePos = {100.0F, down};
    draw(parts);
  }

  // Turns the view by a drag beside the mesh.
  void turn_view(int frame, FrameParts& parts) {
    const Vector2d at(0.95 * size_.width, 0.5 * size_.height);
    ImGui::GetIO().MousePos = {static_cast<float>(at.x()), static_cast<float>(at.y())};
    if (!is_turning_) send(InputKind::press, at);
    is_turning_ = true;
    send(InputKind::move, at + Vector2d(0.0, 5.0 * (frame % kFramesPerRun + 1)));
    draw(parts);
  }
  void end_turning() {
    send(InputKind::release, {0.95 * size_.width, 0.5 * size_.height});
    is_turning_ = false;
  }

 private:
  static std::shared_ptr<gpu::Context> open(const std::string& device) {
    gpu::ContextOptions options;
    options.device = device;
    return std::make_shared<gpu::Context>(options);
  }

  void send(InputKind kind, const Vector2d& at) {
    app_.handle({.kind = kind, .position = at, .button = MouseButton::middle});
  }

  void draw(FrameParts& parts) {
    const Stopwatch frame;
    painter_.finish_frame(times_);
    const Stopwatch layout;
    ImGui::NewFrame();
    app_.draw_ui(times_);
    ImGui::Render();
    times_.panels_ms = layout.elapsed_ms();
    painter_.paint(size_, app_.scene(), *ImGui::GetDrawData(), !is_turning_);
    painter_.finish_frame(times_);
    parts.add(times_, frame.elapsed_ms());
  }

  VkExtent2D size_;
  std::shared_ptr<gpu::Context> context_;
  viewer::OffscreenScreen screen_;
  viewer::FramePainter painter_;
  viewer::ViewerApp app_;
  viewer::FrameTimings times_;
  bool is_turning_ = false;
};

}  // namespace

void print_viewer_frames(const FrameBench& settings, const Mesh& mesh) {
  const TemporaryMesh file(mesh, ".ply");
  WholeViewer whole(settings, file.path());
  FrameParts panels;
  FrameParts camera;
  for (int run = -1; run < settings.repeats; ++run) {
    FrameParts uncounted;
    // The first frame may follow a frame of another kind, so it does not count.
    whole.point_at_panels(0, uncounted);
    for (int f = 1; f <= kFramesPerRun; ++f) {
      whole.point_at_panels(f, run < 0 ? uncounted : panels);
    }
    whole.turn_view(0, uncounted);
    for (int f = 1; f <= kFramesPerRun; ++f) whole.turn_view(f, run < 0 ? uncounted : camera);
    whole.end_turning();
  }
  panels.print("the whole viewer, the cursor over its panels");
  camera.print("the whole viewer, the view is turned");
}

}  // namespace lapwing::bench
