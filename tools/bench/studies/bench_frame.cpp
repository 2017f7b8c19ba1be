#include <array>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <memory>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/gpu/context.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/subdivide.h"
#include "lapwing/render/closed_surface.h"
#include "lapwing/render/id_picture.h"
#include "lapwing/render/surface.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "navigation/camera_motion.h"
#include "run/measure.h"
#include "run/subject.h"
#include "studies/frame_parts.h"
#include "studies/studies.h"
#include "studies/viewer_frames.h"
#include "tools/projection.h"
#include "ui/panels.h"
#include "window/frame_painter.h"
#include "window/offscreen_screen.h"
#include "window/theme.h"

namespace lapwing::bench {
namespace {

using viewer::FrameTimings;
using viewer::Scene;

// Panels about as large as the viewer's.
class Panels {
 public:
  explicit Panels(const FrameBench& settings) {
    ImGui::CreateContext();
    viewer::set_fonts(1.0);
    viewer::set_theme(viewer::Theme::dark, 1.0);
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
  std::vector<viewer::Message> log_ =
      std::vector<viewer::Message>(12, "a line of the log, to be read");
};

// Returns a motion of the handle in which all 12 numbers are in use.
Eigen::Affine3d motion_at(double share, double size) {
  const Eigen::Vector3d shift(0.1 * size * share, 0.05 * size * share, 0.0);
  return Eigen::Translation3d(shift) *
         Eigen::AngleAxisd(0.3 * share, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
}

Mesh subject_of(const FrameBench& settings) {
  Mesh mesh = read_mesh(settings.mesh);
  for (int k = 0; k < settings.subdivisions; ++k) mesh = subdivide(mesh);
  return mesh;
}

// What changes in a frame.
enum class Change { panels, camera, handle };

// How a frame is drawn: as in the viewer; without keeping pictures; or, in addition, at full
// resolution and by one pipeline for all styles.
enum class Painter { viewer, anew, one_pipeline };

// A mesh that is dragged and drawn offscreen, frame by frame.
class DraggedMesh {
 public:
  explicit DraggedMesh(const FrameBench& settings)
      : mesh_(subject_of(settings)),
        topology_(mesh_.topology()),
        context_(open(settings.device)),
        kernels_(context_, Precision::automatic),
        deformer_(mesh_.positions, topology_, whole_mesh_region(mesh_), {}, kernels_),
        drag_(deformer_.response()),
        surface_(context_, mesh_.positions, topology_),
        blend_(upload_response(context_, drag_.response()->columns(), topology_)),
        paint_(surface_),
        panels_(settings),
        kept_(context_, {}),
        fine_(context_, {.keeps_pictures = false}),
        one_pipeline_(
            context_,
            {.keeps_pictures = false, .moving_pixels = 1, .pipelines = Renderer::Pipelines::one}),
        size_{settings.width, settings.height},
        diagonal_(bounds_of(mesh_.positions).diagonal()),
        closed_(is_closed_outward(mesh_.positions, topology_.triangles)) {
    paint_.set_polygons(mesh_);
    paint_.set_classes(vertex_classes(deformer_.region(), mesh_.vertex_count()));
    surface_.begin(*blend_, mesh_.positions);
    scene_.surface = &surface_;
    scene_.paint = &paint_;
    scene_.style.color = SurfaceColor::regions;
    scene_.camera = fit(bounds_of(mesh_.positions), view_axes(View::three_quarter),
                        static_cast<double>(settings.width) / settings.height);
    camera_ = scene_.camera;
  }

  // Draws one frame. With `quick` it draws as the window does while something moves.
  void paint(Change change, bool quick, Painter by, FrameParts& parts) {
    const Stopwatch frame;
    ++frames_;
    if (change == Change::handle) {
      const std::array motions{motion_at(0.5 + 0.5 * std::sin(0.2 * frames_), diagonal_)};
      surface_.blend(blend_, drag_.parameters(motions));
    }
    if (change == Change::camera) {
      // Use the same views for every kind of frame.
      const double turned = 5.0 * (frames_ % (kFramesPerRun + 1) + 1);
      scene_.camera =
          viewer::orbited(camera_, {turned, 0.0}, Eigen::Vector2d(size_.width, size_.height),
                          Eigen::Vector3d::UnitY());
      fit_depth(scene_.camera, bounds_of(mesh_.positions));
    }
    scene_.moving = quick;
    scene_.style.sides = quick && closed_ ? Sides::front : Sides::both;
    const Stopwatch layout;
    const ImDrawData& laid_out = panels_.lay_out(times_);
    times_.panels_ms = layout.elapsed_ms();
    viewer::FramePainter& painter = window(by).painter;
    painter.paint(size_, scene_, laid_out);
    painter.finish_frame(times_);
    parts.add(times_, frame.elapsed_ms());
  }

  // Picks the triangle in the middle of the window in a frame of a drag: along the line of sight,
  // as the viewer does, and by a picture of triangle numbers, which the device must draw first.
  void pick(Samples& along_ray, Samples& by_picture) {
    const Eigen::Vector2d size(size_.width, size_.height);
    const viewer::Projection projection(
        scene_.camera.projection(size.x() / size.y()) * scene_.camera.view(), size);
    const std::array motions{motion_at(1.0, diagonal_)};
    const Stopwatch of_ray;
    dragged_ = mesh_.positions;
    drag_.move(motions, dragged_);
    const auto found =
        viewer::pick_surface(topology_, dragged_, projection.ray_through(0.5 * size));
    along_ray.milliseconds.push_back(of_ray.elapsed_ms());
    const Stopwatch of_picture;
    picture_of_ids_.draw(surface_, scene_.camera, size_.width, size_.height);
    const auto seen = picture_of_ids_.pick(surface_, size_.width / 2, size_.height / 2);
    by_picture.milliseconds.push_back(of_picture.elapsed_ms());
    if (found.has_value() != seen.has_value()) std::puts("the two do not see the same");
  }

  std::size_t vertex_count() const { return mesh_.vertex_count(); }
  const std::string& device() const { return context_->description().name; }
  std::uint32_t coarseness() const { return kept_.painter.picture().pixels_per_pixel(); }
  Image picture() { return kept_.screen.picture(); }

 private:
  struct Window {
    Window(const std::shared_ptr<gpu::Context>& context, const viewer::PaintingOptions& options)
        : screen(*context), painter(*context, screen, options) {
      painter.set_fonts();
    }

    viewer::OffscreenScreen screen;
    viewer::FramePainter painter;
  };

  static std::shared_ptr<gpu::Context> open(const std::string& device) {
    gpu::ContextOptions options;
    options.device = device;
    return std::make_shared<gpu::Context>(options);
  }

  Window& window(Painter by) {
    if (by == Painter::viewer) return kept_;
    return by == Painter::anew ? fine_ : one_pipeline_;
  }

  Mesh mesh_;
  const Topology& topology_;
  std::shared_ptr<gpu::Context> context_;
  VulkanKernels kernels_;
  DeformSolver deformer_;
  Drag drag_;
  Surface surface_;
  std::shared_ptr<BlendResponse> blend_;
  SurfacePaint paint_;
  Panels panels_;
  Window kept_;
  Window fine_;
  Window one_pipeline_;
  IdPicture picture_of_ids_{*context_};
  Positions dragged_;
  Scene scene_;
  Camera camera_;  // initial
  VkExtent2D size_;
  double diagonal_;
  bool closed_;
  FrameTimings times_;
  int frames_ = 0;
};

// A kind of frame, and its title.
struct Kind {
  const char* title;
  Change change;
  bool quick;
  Painter by;
};
constexpr std::array<Kind, 7> kKinds{
    {{"the panels change, picture kept", Change::panels, false, Painter::viewer},
     {"the panels change, picture drawn anew", Change::panels, false, Painter::anew},
     {"the panels change, drawn anew, one pipeline", Change::panels, false, Painter::one_pipeline},
     {"the camera moves", Change::camera, true, Painter::viewer},
     {"the camera moves, full resolution, one pipeline", Change::camera, true,
      Painter::one_pipeline},
     {"the eye jumps, as with a wheel", Change::camera, false, Painter::viewer},
     {"a handle is dragged", Change::handle, true, Painter::viewer}}};

void print_dragged_mesh(const FrameBench& settings) {
  DraggedMesh dragged(settings);
  std::array<FrameParts, kKinds.size()> measured;
  std::uint32_t coarseness = 1;
  for (int run = -1; run < settings.repeats; ++run) {
    for (std::size_t k = 0; k < kKinds.size(); ++k) {
      const Kind& kind = kKinds[k];
      FrameParts uncounted;
      // The first frame may follow a frame of another kind, so it does not count.
      dragged.paint(kind.change, kind.quick, kind.by, uncounted);
      for (int f = 0; f < kFramesPerRun; ++f) {
        dragged.paint(kind.change, kind.quick, kind.by, run < 0 ? uncounted : measured[k]);
      }
      if (kind.change == Change::camera && kind.quick && kind.by == Painter::viewer) {
        coarseness = dragged.coarseness();
      }
    }
  }
  std::printf("%s: %zu vertices, device %s, %u x %u pixels, %d frames of each kind, ms\n",
              std::filesystem::path(settings.mesh).filename().c_str(), dragged.vertex_count(),
              dragged.device().c_str(), settings.width, settings.height,
              kFramesPerRun * settings.repeats);
  std::printf("while the camera moves, one pixel drawn stands for %u x %u\n", coarseness,
              coarseness);
  for (std::size_t k = 0; k < kKinds.size(); ++k) measured[k].print(kKinds[k].title);
  Samples along_ray;
  Samples by_picture;
  for (int k = 0; k < kFramesPerRun * settings.repeats; ++k) dragged.pick(along_ray, by_picture);
  const auto print = [](const char* title, const Samples& samples) {
    std::printf("    %-46s %10.2f %10.2f %10.2f\n", title, samples.median(), samples.min(),
                samples.max());
  };
  std::puts("  what is under the cursor in a drag");
  print("along the line of sight, processor", along_ray);
  print("by a picture drawn for it, device", by_picture);
  if (!settings.picture.empty()) write_png(settings.picture, dragged.picture());
}

}  // namespace

void bench_frame(const FrameBench& settings) {
  print_dragged_mesh(settings);
  print_viewer_frames(settings, subject_of(settings));
}

}  // namespace lapwing::bench
