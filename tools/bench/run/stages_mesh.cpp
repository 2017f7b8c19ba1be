#include <filesystem>
#include <string>
#include <unistd.h>

#include "lapwing/doctor/check.h"
#include "lapwing/gpu/context.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/offscreen.h"
#include "lapwing/render/renderer.h"
#include "lapwing/render/surface.h"
#include "lapwing/render/surface_paint.h"
#include "run/bench_run.h"

namespace lapwing::bench {
namespace {

// A temporary mesh file. Its name contains the process id, so that parallel runs do not collide.
class TemporaryMesh {
 public:
  // Writes the mesh in the format of `extension`, such as ".obj".
  TemporaryMesh(const Mesh& mesh, const std::string& extension)
      : path_(std::filesystem::temp_directory_path() /
              ("lapwing-bench-" + std::to_string(getpid()) + extension)) {
    write_mesh(mesh, path_);
  }
  ~TemporaryMesh() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryMesh(const TemporaryMesh&) = delete;
  TemporaryMesh& operator=(const TemporaryMesh&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 800;

void measure_reading(BenchRun& run, const std::string& stage, const std::string& extension) {
  const Subject& subject = run.subject();
  if (!run.wants(stage, run.processor())) return;
  // Copy the bare mesh: a mesh that was read from a file is written back as that file.
  Mesh mesh;
  mesh.positions = subject.mesh.positions;
  for (const Triangle& t : subject.mesh.topology().triangles) mesh.add_face(t);
  const TemporaryMesh file(mesh, extension);
  Measurement* const row = run.measure(stage, [&] { read_mesh(file.path()); });
  row->counts["file bytes"] = std::filesystem::file_size(file.path());
}

}  // namespace

void measure_mesh_stages(BenchRun& run) {
  const Subject& subject = run.subject();
  measure_reading(run, "read OBJ", ".obj");
  measure_reading(run, "read PLY", ".ply");
  run.measure("topology", [&] { build_topology(subject.mesh); });
  run.measure("check", [&] { check(subject.mesh); });
}

void measure_render(BenchRun& run) {
  const Subject& subject = run.subject();
  for (const BenchDevice& kept : run.devices()) {
    if (kept.context == nullptr || !kept.context->has_graphics()) continue;
    const bool wanted = run.wants("render", kept) || run.wants("show mesh", kept);
    if (!wanted) continue;
    // Once Mesa's software device has drawn, each of its timestamps takes some microseconds more.
    const BenchDevice device = open_bench_device(kept.name);
    run.measure("show mesh", device, [&] {
      Surface shown(device.context, subject.mesh.positions, subject.mesh.topology());
      shown.place(subject.mesh.positions);
    });
    // The rest pose suffices, because the cost of an image does not depend on the positions.
    const Surface surface(device.context, subject.mesh.positions, subject.mesh.topology());
    SurfacePaint paint(surface);
    paint.set_classes(vertex_classes(subject.region, subject.vertices()));
    SurfaceStyle style;
    style.color = SurfaceColor::regions;
    OffscreenTarget target(*device.context, kWidth, kHeight);
    const Renderer renderer(*device.context, target.format());
    const Camera camera = fit(bounds_of(subject.mesh.positions), view_axes(View::three_quarter),
                              static_cast<double>(kWidth) / static_cast<double>(kHeight));
    run.measure("render", device, [&] {
      target.render([&](VkCommandBuffer commands) {
        renderer.begin(commands, target.extent(), Background::gradient);
        renderer.draw(commands, target.extent(), surface, paint, camera, style);
      });
    });
  }
}

}  // namespace lapwing::bench
