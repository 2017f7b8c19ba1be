#include <array>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <memory>

#include "benches.h"
#include "lapwing/deform/deformer.h"
#include "lapwing/gpu/context.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/render/closed_surface.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "lapwing/vulkan/vulkan_surface.h"
#include "measure.h"
#include "ui/panels.h"
#include "whole_mesh_region.h"
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

}  // namespace

void bench_frame(const FrameBench& settings) {
  const Mesh mesh = read_mesh(settings.mesh);
  const Topology topology = build_topology(mesh);
  gpu::ContextOptions device;
  device.device = settings.device;
  const auto context = std::make_shared<gpu::Context>(device);
  VulkanKernels kernels(context, Precision::automatic);
  const EditRegion region = whole_mesh_region(mesh);
  Deformer deformer(mesh.positions, topology, region, {}, kernels);
  auto& surface = dynamic_cast<VulkanSurface&>(deformer.surface());
  SurfacePaint paint(surface);
  paint.set_polygons(mesh, topology);
  paint.set_classes(vertex_classes(region, mesh.vertex_count()));

  viewer::OffscreenScreen screen(*context);
  viewer::FramePainter painter(*context, screen);
  Panels panels(settings);
  painter.set_fonts();
  const Bounds bounds = bounds_of(mesh.positions);
  Scene scene;
  scene.surface = &surface;
  scene.paint = &paint;
  scene.style.color = SurfaceColor::regions;
  scene.camera = fit(bounds, view_axes(View::three_quarter),
                     static_cast<double>(settings.width) / settings.height);

  const VkExtent2D size{settings.width, settings.height};
  FrameTimings times;
  int frames = 0;
  // A drag frame, drawn as the window does while something moves, or as it does afterwards.
  const bool closed = is_closed_outward(mesh.positions, topology.triangles);
  const auto frame = [&](bool quick) {
    const Stopwatch watch;
    const double share = 0.5 + 0.5 * std::sin(0.2 * ++frames);
    const std::array motions{motion_at(share, bounds.diagonal())};
    deformer.drag(motions);
    scene.moving = quick;
    scene.style.sides = quick && closed ? Sides::front : Sides::both;
    const Stopwatch layout;
    const ImDrawData& laid_out = panels.lay_out(times);
    times.panels_ms = layout.elapsed_ms();
    painter.paint(size, scene, laid_out);
    painter.finish_frame(times);
    return watch.elapsed_ms();
  };

  Parts quick;
  Parts fine;
  frame(true);
  frame(false);
  for (int run = 0; run < settings.repeats; ++run) {
    for (int f = 0; f < kFramesPerRun; ++f) {
      const double ms = frame(true);
      quick.add(times, ms);
    }
    for (int f = 0; f < kFramesPerRun; ++f) {
      const double ms = frame(false);
      fine.add(times, ms);
    }
  }
  std::printf("%s: %zu vertices, device %s, %u x %u pixels, %zu drag frames of each kind\n",
              std::filesystem::path(settings.mesh).filename().c_str(), mesh.vertex_count(),
              context->description().name.c_str(), settings.width, settings.height,
              quick.parts[0].milliseconds.size());
  quick.print("drawn as while it moves, ms");
  fine.print("drawn as when it rests, ms");
  if (!settings.picture.empty()) write_png(settings.picture, screen.picture());
}

}  // namespace lapwing::bench
