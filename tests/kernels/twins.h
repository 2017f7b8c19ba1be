#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/vulkan/vulkan_kernels.h"
#include "support/gpu.h"

namespace lapwing::test {

/// An implementation of the kernels, and its tolerance.
struct Twin {
  const char* name;
  bool on_gpu;
  Precision precision;
  bool mapped;       ///< false: every copy is staged, as on a discrete GPU
  double tolerance;  ///< relative tolerance of kernels in this precision
};

inline constexpr double kFloat64Tolerance = 1e-12;
inline constexpr double kFloat32Tolerance = 1e-5;
inline constexpr Twin kTwins[] = {
    {"cpu", false, Precision::float64, true, kFloat64Tolerance},
    {"vulkan_float64", true, Precision::float64, true, kFloat64Tolerance},
    {"vulkan_float32", true, Precision::float32, true, kFloat32Tolerance},
    {"vulkan_float32_staged", true, Precision::float32, false, kFloat32Tolerance},
};

/// A test that runs with every twin that is available on this machine.
class KernelTest : public ::testing::TestWithParam<Twin> {
 protected:
  void SetUp() override {
    if (!GetParam().on_gpu) {
      kernels = std::make_unique<CpuKernels>();
      return;
    }
    LAPWING_NEEDS_GPU();
    gpu::ContextOptions options;
    options.map_device_memory = GetParam().mapped;
    context = std::make_shared<gpu::Context>(options);
    if (GetParam().precision == Precision::float64 && !context->description().float64) {
      GTEST_SKIP() << "no float64 on " << context->description().name;
    }
    kernels = std::make_unique<VulkanKernels>(context, GetParam().precision);
  }

  /// Returns the tolerance of positions and normals relative to the size of the mesh. Devices store
  /// them in float32.
  double surface_tolerance() const { return GetParam().on_gpu ? 1e-6 : 1e-13; }

  std::shared_ptr<gpu::Context> context;  ///< null for the CPU twins
  std::unique_ptr<Kernels> kernels;
};

#define LAPWING_ON_ALL_TWINS(fixture)                                         \
  INSTANTIATE_TEST_SUITE_P(Twins, fixture, ::testing::ValuesIn(test::kTwins), \
                           [](const auto& test) { return std::string(test.param.name); })

}  // namespace lapwing::test
