#include "lapwing/vulkan/vulkan_kernels.h"

#include <cstdint>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/shaders/assemble_rsi_float32.h"
#include "lapwing/shaders/assemble_rsi_float64.h"
#include "lapwing/shaders/assemble_tangent_float32.h"
#include "lapwing/shaders/assemble_tangent_float64.h"
#include "lapwing/shaders/energy_gradient_float32.h"
#include "lapwing/shaders/energy_gradient_float64.h"
#include "lapwing/shaders/fit_rotations_float32.h"
#include "lapwing/shaders/fit_rotations_float64.h"
#include "lapwing/shaders/rotate_frames_float32.h"
#include "lapwing/shaders/rotate_frames_float64.h"
#include "lapwing/shaders/sample_laplacians_float32.h"
#include "lapwing/shaders/sample_laplacians_float64.h"
#include "lapwing/shaders/sample_mapped_laplacians_float32.h"
#include "lapwing/shaders/sample_mapped_laplacians_float64.h"
#include "lapwing/vulkan/vulkan_ring_rotations.h"
#include "lapwing/vulkan/vulkan_state.h"

namespace lapwing {
namespace {

// Most kernels have one push constant: the number of rows or vertices.
constexpr std::uint32_t kCountBytes = sizeof(std::uint32_t);
// Push constants of shaders/rotations.glsl.
constexpr std::uint32_t kRotationsBytes = 5 * sizeof(std::uint32_t);
// Push constants of shaders/mapped_ring.glsl.
constexpr std::uint32_t kMappedRingBytes = 3 * sizeof(std::uint32_t);

std::shared_ptr<gpu::Context> make_context(const VulkanOptions& options) {
  gpu::ContextOptions context_options;
  context_options.device = options.device;
  context_options.validation = options.validation;
  return std::make_shared<gpu::Context>(context_options);
}

bool choose_float64(const gpu::Context& context, Precision precision) {
  const bool available = context.description().float64;
  if (precision == Precision::float64 && !available) {
    throw GpuError(context.description().name +
                   " does not support float64 (shaderFloat64); choose the precision float32 or "
                   "another device");
  }
  return available && precision != Precision::float32;
}

DeviceInfo describe(const VulkanState& state) {
  const gpu::DeviceDescription& device = state.context->description();
  return {device.name, device.type, device.driver, state.float64, state.frames};
}

}  // namespace

VulkanState::VulkanState(std::shared_ptr<gpu::Context> shared_context, bool in_float64,
                         bool frames_on_device)
    : context(std::move(shared_context)),
      float64(in_float64),
      frames(frames_on_device || context->description().type != "software"),
      transfer(*context),
      assemble_rsi(*context, "assemble_rsi",
                   float64 ? shaders::assemble_rsi_float64() : shaders::assemble_rsi_float32(),
                   kCountBytes),
      assemble_tangent(
          *context, "assemble_tangent",
          float64 ? shaders::assemble_tangent_float64() : shaders::assemble_tangent_float32(),
          kCountBytes),
      energy_gradient(
          *context, "energy_gradient",
          float64 ? shaders::energy_gradient_float64() : shaders::energy_gradient_float32(),
          kRotationsBytes),
      fit_rotations(*context, "fit_rotations",
                    float64 ? shaders::fit_rotations_float64() : shaders::fit_rotations_float32(),
                    kRotationsBytes),
      rotate_frames(*context, "rotate_frames",
                    float64 ? shaders::rotate_frames_float64() : shaders::rotate_frames_float32(),
                    kMappedRingBytes),
      sample_laplacians(
          *context, "sample_laplacians",
          float64 ? shaders::sample_laplacians_float64() : shaders::sample_laplacians_float32(),
          kCountBytes),
      sample_mapped_laplacians(*context, "sample_mapped_laplacians",
                               float64 ? shaders::sample_mapped_laplacians_float64()
                                       : shaders::sample_mapped_laplacians_float32(),
                               kMappedRingBytes) {}

VulkanKernels::VulkanKernels(const VulkanOptions& options)
    : VulkanKernels(make_context(options), options.precision, options.frames_on_device) {}

VulkanKernels::VulkanKernels(std::shared_ptr<gpu::Context> context, Precision precision,
                             bool frames_on_device)
    : state_(std::make_shared<VulkanState>(context, choose_float64(*context, precision),
                                           frames_on_device)),
      device_(describe(*state_)) {}

VulkanKernels::~VulkanKernels() = default;

std::unique_ptr<RingRotations> VulkanKernels::make_ring_rotations(
    std::shared_ptr<const RegionRings> rings) {
  return std::make_unique<VulkanRingRotations>(state_, *rings);
}

const std::shared_ptr<gpu::Context>& VulkanKernels::context() const {
  return state_->context;
}

}  // namespace lapwing
