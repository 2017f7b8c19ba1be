#include <array>
#include <chrono>
#include <cstdio>
#include <imgui.h>
#include <memory>
#include <thread>

#include "lapwing/gpu/context.h"
#include "report/report.h"
#include "studies/studies.h"
#include "ui/viewer_app.h"
#include "window/frame_painter.h"
#include "window/offscreen_screen.h"
#include "window/theme.h"

namespace lapwing::bench {
namespace {

using Eigen::Vector2d;
using viewer::FrameTimings;
using viewer::InputKind;

// The number of frames of each kind in one measured run.
constexpr int kFramesPerRun = 8;

// Records the times of the parts of a frame, for frames of one kind. The parts are in the order of
// the table.
struct FrameParts {
  std::array<std::vector<double>, 4> parts_ms;

  void add(const FrameTimings& times, double frame_ms) {
    const std::array values{times.draw_ms, times.ui_ms, times.panels_ms, frame_ms};
    for (std::size_t p = 0; p < values.size(); ++p) parts_ms[p].push_back(values[p]);
  }

  void print(const char* title) const {
    std::printf("%-24s", title);
    for (const auto& ms : parts_ms) std::printf(" %14.2f", median_of(ms));
    std::printf("\n");
  }
};

// Runs the viewer in an offscreen window with its default panels. It does not save settings.
class WholeViewer {
 public:
  explicit WholeViewer(const FrameBench& settings)
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
    app_.open(settings.mesh);
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
    ImGui::GetIO().MousePos = {100.0F, 60.0F + 30.0F * static_cast<float>(frame)};
    draw(parts);
  }

  // Rotates the view by a mouse drag beside the mesh.
  void turn_view(int frame, FrameParts& parts) {
    const Vector2d at(0.95 * size_.width, 0.5 * size_.height);
    ImGui::GetIO().MousePos = {static_cast<float>(at.x()), static_cast<float>(at.y())};
    if (frame == 0) send(InputKind::press, at);
    is_turning_ = true;
    send(InputKind::move, at + Vector2d(0.0, 5.0 * (frame + 1)));
    draw(parts);
    if (frame < kFramesPerRun) return;
    send(InputKind::release, at);
    is_turning_ = false;
  }

  const std::string& device() const { return context_->description().name; }

 private:
  static std::shared_ptr<gpu::Context> open(const std::string& device) {
    gpu::ContextOptions options;
    options.device = device;
    return std::make_shared<gpu::Context>(options);
  }

  void send(InputKind kind, const Vector2d& at) {
    app_.handle({.kind = kind, .position = at, .button = viewer::MouseButton::middle});
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
  FrameTimings times_;
  bool is_turning_ = false;
};

// Draws the frames of one run. Before them, it draws one frame that is not measured, because that
// frame may follow a frame of another kind.
void draw_run(WholeViewer& viewer, void (WholeViewer::*draw)(int, FrameParts&), FrameParts& parts) {
  FrameParts uncounted;
  for (int f = 0; f <= kFramesPerRun; ++f) (viewer.*draw)(f, f == 0 ? uncounted : parts);
}

}  // namespace

void bench_frame(const FrameBench& settings) {
  WholeViewer viewer(settings);
  FrameParts uncounted;
  FrameParts panels;
  FrameParts camera;
  for (int run = -1; run < settings.repeats; ++run) {
    draw_run(viewer, &WholeViewer::point_at_panels, run < 0 ? uncounted : panels);
    draw_run(viewer, &WholeViewer::turn_view, run < 0 ? uncounted : camera);
  }
  std::printf("%s, %s, %u x %u pixels, medians in ms\n", settings.mesh.c_str(),
              viewer.device().c_str(), settings.width, settings.height);
  std::printf("%-24s %14s %14s %14s %11s\n", "", "surface, device", "panels, device", "panels, CPU",
              "whole frame");
  panels.print("cursor over the panels");
  camera.print("view turned");
}

}  // namespace lapwing::bench
