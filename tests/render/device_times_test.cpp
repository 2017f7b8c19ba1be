// Drawing once made a software device put its timestamps off, so that kernels seemed to take no
// time. All times compared here are the device's own; what is left of a wrong one is a hundredth.

#include <memory>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/gpu/context.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/render/offscreen.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "lapwing/vulkan/vulkan_surface.h"
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
    const std::vector<double> basis(3 * moving.size(), 1.0);
    made = VulkanKernels(context, Precision::automatic)
               .make_surface({mesh.positions, mesh.topology(), moving, basis, 1});
    drag();  // the first one is the slowest
  }

  SurfaceTimes drag() {
    auto& surface = dynamic_cast<VulkanSurface&>(*made);
    surface.take_times();
    for (int frame = 0; frame < 5; ++frame) surface.blend(std::vector{0.1 * frame});
    return surface.take_times();
  }

  void draw() {
    OffscreenTarget(*context, 64, 64).render([](VkCommandBuffer) {});
  }

  std::shared_ptr<gpu::Context> context;
  std::unique_ptr<DeformedSurface> made;
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
