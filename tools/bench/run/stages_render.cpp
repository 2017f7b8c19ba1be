#include <memory>
#include <vector>

#include "lapwing/gpu/context.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/offscreen.h"
#include "lapwing/render/renderer.h"
#include "lapwing/render/surface.h"
#include "lapwing/render/surface_paint.h"
#include "run/stages.h"

namespace lapwing::bench {
namespace {

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 800;

}  // namespace

void measure_render(BenchRun& run, const Subject& subject) {
  for (const BenchDevice& kept : run.devices()) {
    if (kept.context == nullptr || !kept.context->has_graphics()) continue;
    const bool wanted = run.wants("render", kLapwing, kept.name, subject) ||
                        run.wants("show mesh", kLapwing, kept.name, subject);
    if (!wanted) continue;
    // Once Mesa's software device has drawn, each of its timestamps takes some microseconds more.
    const BenchDevice device = open_bench_device(kept.name);
    run.measure("show mesh", kLapwing, device, subject, [&] {
      Surface shown(device.context, subject.mesh.positions, subject.mesh.topology());
      shown.place(subject.mesh.positions);
    });
    // The rest pose suffices: the cost of a picture does not depend on the positions.
    const Surface surface(device.context, subject.mesh.positions, subject.mesh.topology());
    SurfacePaint paint(surface);
    paint.set_classes(vertex_classes(subject.region, subject.vertices()));
    SurfaceStyle style;
    style.color = SurfaceColor::regions;
    OffscreenTarget target(*device.context, kWidth, kHeight);
    const Renderer renderer(*device.context, target.format());
    const Camera camera = fit(bounds_of(subject.mesh.positions), view_axes(View::three_quarter),
                              static_cast<double>(kWidth) / static_cast<double>(kHeight));
    run.measure("render", kLapwing, device, subject, [&] {
      target.render([&](VkCommandBuffer commands) {
        renderer.begin(commands, target.extent(), Background::gradient);
        renderer.draw(commands, target.extent(), surface, paint, camera, style);
      });
    });
  }
}

}  // namespace lapwing::bench
