#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/gpu/spirv.h"
#include "lapwing/shaders/assemble_rsi_float32.h"
#include "lapwing/shaders/assemble_rsi_float64.h"
#include "lapwing/shaders/assemble_tangent_float32.h"
#include "lapwing/shaders/blend_response.h"
#include "lapwing/shaders/energy_gradient_float32.h"
#include "lapwing/shaders/fit_rotations_float32.h"
#include "lapwing/shaders/rotate_frames_float32.h"
#include "lapwing/shaders/sample_laplacians_float32.h"
#include "lapwing/shaders/sample_mapped_laplacians_float32.h"
#include "lapwing/shaders/vertex_normals.h"

namespace lapwing {
namespace {

using ::testing::Contains;
using ::testing::Each;

// Numbers of the SPIR-V specification, section 3.31. Every Vulkan device has the first.
constexpr std::uint32_t kShader = 1;
constexpr std::uint32_t kFloat64 = 10;

// Some devices do not support the capabilities Float64, Int64 or Geometry.
TEST(Capabilities, Float32ModulesNeedWhatEveryDeviceHas) {
  for (const auto module : {shaders::assemble_rsi_float32(), shaders::assemble_tangent_float32(),
                            shaders::energy_gradient_float32(), shaders::fit_rotations_float32(),
                            shaders::rotate_frames_float32(), shaders::sample_laplacians_float32(),
                            shaders::sample_mapped_laplacians_float32(), shaders::blend_response(),
                            shaders::vertex_normals()}) {
    EXPECT_THAT(gpu::read_interface(module).capabilities, Each(kShader));
  }
}

TEST(Capabilities, Float64ModuleSaysSo) {
  EXPECT_THAT(gpu::read_interface(shaders::assemble_rsi_float64()).capabilities,
              Contains(kFloat64));
}

}  // namespace
}  // namespace lapwing
