// Tests that an edit continues without loss after any driver call of the edit fails.
#include <array>

#include <gtest/gtest.h>

#include "kernels/moved_mesh.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/gpu/devices.h"
#include "lapwing/kernels/fallback_kernels.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "support/bent_tube.h"
#include "support/faulty_driver.h"
#include "support/gpu.h"
#include "support/linear_options.h"

namespace lapwing {
namespace {

using test::DriverFault;

// Settling uses float64 on both devices. Drawn surfaces use float32.
constexpr double kSettledTolerance = 1e-8;
constexpr double kShownTolerance = 1e-6;

class DeviceFaults : public ::testing::TestWithParam<DriverFault> {
 protected:
  void SetUp() override { LAPWING_NEEDS_GPU(); }

  // A few iterations suffice to make every kind of driver call.
  static DeformOptions few_iterations() {
    DeformOptions options;
    options.settle->max_iterations = 3;
    return options;
  }

  DeformSolver settling(Kernels& kernels) const {
    return DeformSolver(mesh.positions, mesh.topology(), test::foot_and_head(mesh),
                        few_iterations(), kernels);
  }

  // Opens a new context, which is slow, only if the last one was lost.
  void renew_context(bool mapped) {
    if (context != nullptr && GetParam() == DriverFault::memory) return;
    context.reset();
    gpu::ContextOptions options;
    options.map_device_memory = mapped;
    context = std::make_shared<gpu::Context>(options);
  }

  const test::FaultyDriver driver;
  std::shared_ptr<gpu::Context> context;
  const Mesh mesh = test::bumpy_tube();
  const std::array<Eigen::Affine3d, 1> bend{test::bend()};
};

TEST_P(DeviceFaults, SettlingGoesOnOnTheCpu) {
  CpuKernels cpu;
  const Positions expected = settling(cpu).solve(bend).positions;
  const auto act = [&] {
    FallbackKernels kernels(
        [&] { return std::make_unique<VulkanKernels>(context, Precision::automatic, true); });
    const DeformSolver deformer = settling(kernels);
    EXPECT_LT(test::largest_distance(deformer.solve(bend).positions, expected), kSettledTolerance);
    EXPECT_EQ(kernels.device().type == "cpu", driver.has_failed());
    EXPECT_EQ(kernels.device().took_over.empty(), !driver.has_failed());
  };
  EXPECT_GT(test::for_every_call(
                driver, GetParam(), [this] { renew_context(true); }, act),
            20);
}

// A drag on a lost device throws an exception. With the same response, it continues on another
// context.
TEST_P(DeviceFaults, ADragGoesOnFromTheSameResponse) {
  CpuKernels cpu;
  const DeformSolver deformer(mesh.positions, mesh.topology(), test::foot_and_head(mesh),
                              test::linear_options(), cpu);
  const std::shared_ptr<const DragResponse> response = deformer.response();
  Drag drag(response);
  Positions expected = mesh.positions;
  drag.move(bend, expected);
  const auto expect_followed = [&] {
    test::MovedMesh shown(context, mesh.positions, mesh.topology(), response->columns());
    for (int frame = 0; frame < 2; ++frame) shown.blend(drag.parameters(bend));
    EXPECT_LT(test::largest_distance(shown.positions(), expected), kShownTolerance);
  };
  const auto act = [&] {
    try {
      expect_followed();
    } catch (const gpu::DeviceLost&) {
      EXPECT_EQ(GetParam(), DriverFault::loss);
    } catch (const GpuError& error) {
      EXPECT_EQ(GetParam(), DriverFault::memory) << error.what();
      expect_followed();
    }
  };
  EXPECT_GT(test::for_every_call(
                driver, GetParam(), [this] { renew_context(false); }, act),
            5);
}

INSTANTIATE_TEST_SUITE_P(Each, DeviceFaults,
                         ::testing::Values(DriverFault::loss, DriverFault::memory),
                         [](const auto& fault) { return test::name_of(fault.param); });

}  // namespace
}  // namespace lapwing
