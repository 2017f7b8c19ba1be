// Drawing once made a software device put its timestamps off, so that kernels seemed to take no
// time. All times compared here are the device's own; what is left of a wrong one is a hundredth.

#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/gpu/context.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/render/offscreen.h"
#include "lapwing/render/surface.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

// So many vertices that the kernels of a drag take far longer than what surrounds them.
constexpr Index kSide = 400;

class DeviceTimes : public ::testing::Test {
 protected:
  void open(bool profile) {
    gpu::ContextOptions options;
    options.profile = profile;
    // Where it is mapped the processor does the drag of a software device.
    options.map_device_memory = false;
    context = std::make_shared<gpu::Context>(options);
    if (context->limits().timestampComputeAndGraphics == VK_FALSE) {
      GTEST_SKIP() << "a device without timestamps";
    }
    const Mesh mesh = grid(kSide, kSide);
    std::vector<Index> moving(mesh.vertex_count());
    std::iota(moving.begin(), moving.end(), 0U);
    const std::vector<double> column(3 * moving.size(), 1.0);
    surface.emplace(context, mesh.positions, mesh.topology());
    blend = upload_response(context, {moving, 1, column}, mesh.topology());
    surface->begin(*blend, mesh.positions);
    drag();  // the first one is the slowest
  }

  SurfaceTimes drag() {
    SurfaceTimes times;
    gpu::CommandList commands(*context, "drag", 3);
    for (int frame = 0; frame < 5; ++frame) {
      surface->blend(blend, std::vector{0.1 * frame});
      gpu::Recorder recorder(commands);
      recorder.timestamp();
      surface->record_blend(recorder);
      recorder.timestamp();
      surface->record_normals(recorder);
      recorder.timestamp();
      recorder.finish();
      commands.run();
      times.blend_ms += commands.milliseconds_between(0, 1);
      times.normals_ms += commands.milliseconds_between(1, 2);
    }
    return times;
  }

  void draw() {
    OffscreenTarget(*context, 64, 64).render([](VkCommandBuffer) {});
  }

  std::shared_ptr<gpu::Context> context;
  std::optional<Surface> surface;
  std::shared_ptr<BlendResponse> blend;
};

TEST_F(DeviceTimes, OfADragAreNoShorterOnceThereWasAPicture) {
  LAPWING_NEEDS_GPU();
  ASSERT_NO_FATAL_FAILURE(open(false));
  if (IsSkipped()) return;
  const SurfaceTimes before = drag();
  draw();
  const SurfaceTimes after = drag();
  EXPECT_GT(before.blend_ms, 0.0);
  EXPECT_GT(after.blend_ms, 0.1 * before.blend_ms);
  EXPECT_GT(after.normals_ms, 0.1 * before.normals_ms);
}

TEST_F(DeviceTimes, OfKernelsMakeUpADragOnceThereWasAPicture) {
  LAPWING_NEEDS_GPU();
  ASSERT_NO_FATAL_FAILURE(open(true));
  if (IsSkipped()) return;
  draw();
  context->profile()->take();
  drag();
  const gpu::DeviceUse use = context->profile()->take();
  const double kernels_ms =
      use.kernels.at("blend_response").device_ms + use.kernels.at("vertex_normals").device_ms;
  EXPECT_GT(kernels_ms, 0.5 * use.device_ms);
}

}  // namespace
}  // namespace lapwing
