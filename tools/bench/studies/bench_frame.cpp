#include <array>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <memory>

#include "lapwing/deform/deformer.h"
#include "lapwing/gpu/context.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/render/closed_surface.h"
#include "lapwing/render/surface.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "run/measure.h"
#include "run/subject.h"
#include "studies/studies.h"
#include "ui/panels.h"
#include "window/frame_painter.h"
#include "window/offscreen_screen.h"
#include "window/theme.h"

namespace lapwing::bench {
namespace {

using viewer::FrameTimings;
using viewer::Scene;

// Frames of each kind for one counted run.
constexpr int kFramesPerRun = 8;

// Panels about as large as the viewer's.
class Panels {
 public:
  explicit Panels(const FrameBench& settings) {
    ImGui::CreateContext();
    viewer::set_theme(1.0);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(settings.width), static_cast<float>(settings.height)};
    io.DeltaTime = 1.0F / 60.0F;
  }
  ~Panels() { ImGui::DestroyContext(); }
  Panels(const Panels&) = delete;
  Panels& operator=(const Panels&) = delete;

  const ImDrawData& lay_out(const FrameTimings& last) {
    ImGui::NewFrame();
    if (ImGui::BeginMainMenuBar()) {
      ImGui::TextUnformatted("File  View  Help");
      ImGui::EndMainMenuBar();
    }
    const ImGuiViewport& viewport = *ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(viewport.WorkPos);
    ImGui::SetNextWindowSize({300.0F, viewport.WorkSize.y});
    if (ImGui::Begin("Panels")) {
      viewer::draw_timings_panel(last);
      ImGui::TextWrapped("%s", ImGui::GetVersion());
      viewer::draw_log_panel(log_);
    }
    ImGui::End();
    ImGui::Render();
    return *ImGui::GetDrawData();
  }

 private:
  std::vector<std::string> log_ = std::vector<std::string>(12, "a line of the log, to be read");
};

// What a frame costs, part by part, in the order of the table.
struct Parts {
  std::array<Samples, 6> parts;

  void add(const FrameTimings& times, double frame_ms) {
    const std::array values{times.blend_ms, times.normals_ms, times.draw_ms,
                            times.ui_ms,    times.panels_ms,  frame_ms};
    for (std::size_t p = 0; p < values.size(); ++p) parts[p].milliseconds.push_back(values[p]);
  }

  void print(const char* title) const {
    constexpr std::array kNames{"blend, device",  "normals, device",   "surface, device",
                                "panels, device", "panels, processor", "whole frame"};
    std::printf("  %-28s %10s %10s %10s\n", title, "median", "min", "max");
    for (std::size_t p = 0; p < parts.size(); ++p) {
      std::printf("    %-26s %10.2f %10.2f %10.2f\n", kNames[p], parts[p].median(), parts[p].min(),
                  parts[p].max());
    }
    const double compute = parts[0].median() + parts[1].median();
    std::printf("    %-26s %10.3f\n", "compute / whole frame", compute / parts[5].median());
  }
};

// The handle on its way: all 12 numbers of its motion are in use.
Eigen::Affine3d motion_at(double share, double size) {
  const Eigen::Vector3d shift(0.1 * size * share, 0.05 * size * share, 0.0);
  return Eigen::Translation3d(shift) *
         Eigen::AngleAxisd(0.3 * share, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
}

// A mesh on its way through the frames of a window that nobody sees.
class DraggedMesh {
 public:
  explicit DraggedMesh(const FrameBench& settings)
      : mesh_(read_mesh(settings.mesh)),
        topology_(mesh_.topology()),
        context_(open(settings.device)),
        kernels_(context_, Precision::automatic),
        deformer_(mesh_.positions, topology_, whole_mesh_region(mesh_), {}, kernels_),
        drag_(deformer_.response()),
        surface_(context_, mesh_.positions, topology_),
        blend_(upload_response(context_, drag_.response()->columns(), topology_)),
        paint_(surface_),
        screen_(*context_),
        painter_(*context_, screen_),
        panels_(settings),
        size_{settings.width, settings.height},
        diagonal_(bounds_of(mesh_.positions).diagonal()),
        closed_(is_closed_outward(mesh_.positions, topology_.triangles)) {
    painter_.set_fonts();
    paint_.set_polygons(mesh_);
    paint_.set_classes(vertex_classes(deformer_.region(), mesh_.vertex_count()));
    surface_.begin(*blend_, mesh_.positions);
    scene_.surface = &surface_;
    scene_.paint = &paint_;
    scene_.style.color = SurfaceColor::regions;
    scene_.camera = fit(bounds_of(mesh_.positions), view_axes(View::three_quarter),
                        static_cast<double>(settings.width) / settings.height);
  }

  // One frame, drawn as the window does while something moves or as when nothing does.
  void drag(bool quick, Parts& parts) {
    const Stopwatch frame;
    const std::array motions{motion_at(0.5 + 0.5 * std::sin(0.2 * ++frames_), diagonal_)};
    surface_.blend(blend_, drag_.parameters(motions));
    scene_.moving = quick;
    scene_.style.sides = quick && closed_ ? Sides::front : Sides::both;
    const Stopwatch layout;
    const ImDrawData& laid_out = panels_.lay_out(times_);
    times_.panels_ms = layout.elapsed_ms();
    painter_.paint(size_, scene_, laid_out);
    painter_.finish_frame(times_);
    parts.add(times_, frame.elapsed_ms());
  }

  std::size_t vertex_count() const { return mesh_.vertex_count(); }
  const std::string& device() const { return context_->description().name; }
  Image picture() { return screen_.picture(); }

 private:
  static std::shared_ptr<gpu::Context> open(const std::string& device) {
    gpu::ContextOptions options;
    options.device = device;
    return std::make_shared<gpu::Context>(options);
  }

  Mesh mesh_;
  const Topology& topology_;
  std::shared_ptr<gpu::Context> context_;
  VulkanKernels kernels_;
  Deformer deformer_;
  Drag drag_;
  Surface surface_;
  std::shared_ptr<BlendResponse> blend_;
  SurfacePaint paint_;
  viewer::OffscreenScreen screen_;
  viewer::FramePainter painter_;
  Panels panels_;
  Scene scene_;
  VkExtent2D size_;
  double diagonal_;
  bool closed_;
  FrameTimings times_;
  int frames_ = 0;
};

}  // namespace

void bench_frame(const FrameBench& settings) {
  DraggedMesh dragged(settings);
  Parts quick;
  Parts fine;
  Parts uncounted;
  dragged.drag(true, uncounted);
  dragged.drag(false, uncounted);
  for (int run = 0; run < settings.repeats; ++run) {
    for (int f = 0; f < kFramesPerRun; ++f) dragged.drag(true, quick);
    for (int f = 0; f < kFramesPerRun; ++f) dragged.drag(false, fine);
  }
  std::printf("%s: %zu vertices, device %s, %u x %u pixels, %d drag frames of each kind\n",
              std::filesystem::path(settings.mesh).filename().c_str(), dragged.vertex_count(),
              dragged.device().c_str(), settings.width, settings.height,
              kFramesPerRun * settings.repeats);
  quick.print("drawn as while it moves, ms");
  fine.print("drawn as when it rests, ms");
  if (!settings.picture.empty()) write_png(settings.picture, dragged.picture());
}

}  // namespace lapwing::bench
