#include "lapwing/vulkan/vulkan_state.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lapwing/shaders/assemble_rsi_float32.h"
#include "lapwing/shaders/assemble_rsi_float64.h"
#include "lapwing/shaders/assemble_tangent_float32.h"
#include "lapwing/shaders/assemble_tangent_float64.h"
#include "lapwing/shaders/energy_gradient_float32.h"
#include "lapwing/shaders/energy_gradient_float64.h"
#include "lapwing/shaders/fit_rotations_float32.h"
#include "lapwing/shaders/fit_rotations_float64.h"
#include "lapwing/shaders/prolongate_float32.h"
#include "lapwing/shaders/prolongate_float64.h"
#include "lapwing/shaders/rotate_frames_float32.h"
#include "lapwing/shaders/rotate_frames_float64.h"
#include "lapwing/shaders/sample_laplacians_float32.h"
#include "lapwing/shaders/sample_laplacians_float64.h"
#include "lapwing/shaders/sample_mapped_laplacians_float32.h"
#include "lapwing/shaders/sample_mapped_laplacians_float64.h"
#include "lapwing/shaders/show_displacement_float32.h"
#include "lapwing/shaders/show_displacement_float64.h"
#include "lapwing/shaders/smooth_float32.h"
#include "lapwing/shaders/smooth_float64.h"

namespace lapwing {
namespace {

// Most kernels have one push constant: the number of rows or vertices.
constexpr std::uint32_t kCountBytes = sizeof(std::uint32_t);
// Push constants of shaders/rotations.glsl.
constexpr std::uint32_t kRotationsBytes = 5 * sizeof(std::uint32_t);
// Push constants of shaders/mapped_ring.glsl.
constexpr std::uint32_t kMappedRingBytes = 3 * sizeof(std::uint32_t);
constexpr std::uint32_t kProlongateBytes = 2 * sizeof(std::uint32_t);
constexpr std::uint32_t kSmoothBytes = 4 * sizeof(std::uint32_t);
constexpr std::uint32_t kShowBytes = 4 * sizeof(std::uint32_t);

using Spirv = std::span<const std::uint32_t>;

gpu::Kernel kernel(const VulkanPrograms& programs, std::string name, Spirv float64, Spirv float32,
                   std::uint32_t push_constant_bytes) {
  return {*programs.context, std::move(name), programs.float64 ? float64 : float32,
          push_constant_bytes};
}

}  // namespace

VulkanPrograms::VulkanPrograms(std::shared_ptr<gpu::Context> shared_context, bool in_float64)
    : context(std::move(shared_context)),
      float64(in_float64),
      assemble_rsi(kernel(*this, "assemble_rsi", shaders::assemble_rsi_float64(),
                          shaders::assemble_rsi_float32(), kCountBytes)),
      assemble_tangent(kernel(*this, "assemble_tangent", shaders::assemble_tangent_float64(),
                              shaders::assemble_tangent_float32(), kCountBytes)),
      energy_gradient(kernel(*this, "energy_gradient", shaders::energy_gradient_float64(),
                             shaders::energy_gradient_float32(), kRotationsBytes)),
      fit_rotations(kernel(*this, "fit_rotations", shaders::fit_rotations_float64(),
                           shaders::fit_rotations_float32(), kRotationsBytes)),
      prolongate(kernel(*this, "prolongate", shaders::prolongate_float64(),
                        shaders::prolongate_float32(), kProlongateBytes)),
      rotate_frames(kernel(*this, "rotate_frames", shaders::rotate_frames_float64(),
                           shaders::rotate_frames_float32(), kMappedRingBytes)),
      sample_laplacians(kernel(*this, "sample_laplacians", shaders::sample_laplacians_float64(),
                               shaders::sample_laplacians_float32(), kCountBytes)),
      sample_mapped_laplacians(
          kernel(*this, "sample_mapped_laplacians", shaders::sample_mapped_laplacians_float64(),
                 shaders::sample_mapped_laplacians_float32(), kMappedRingBytes)),
      show_displacement(kernel(*this, "show_displacement", shaders::show_displacement_float64(),
                               shaders::show_displacement_float32(), kShowBytes)),
      smooth(kernel(*this, "smooth", shaders::smooth_float64(), shaders::smooth_float32(),
                    kSmoothBytes)) {}

VulkanState::VulkanState(std::shared_ptr<const VulkanPrograms> of, bool frames_on_device)
    : programs(std::move(of)),
      context(programs->context),
      float64(programs->float64),
      frames(frames_on_device || context->description().type != "software"),
      transfer(*context) {}

std::size_t VulkanState::real_bytes(std::size_t count) const {
  return count * (float64 ? sizeof(double) : sizeof(float));
}

void VulkanState::upload_reals(const gpu::Buffer& buffer, std::span<const double> numbers) {
  if (float64) {
    transfer.upload(buffer, numbers);
  } else {
    const std::vector<float> rounded(numbers.begin(), numbers.end());
    transfer.upload(buffer, rounded);
  }
}

void VulkanState::download_reals(const gpu::Buffer& buffer, std::span<double> numbers) {
  if (float64) {
    transfer.download(buffer, numbers);
  } else {
    std::vector<float> values(numbers.size());
    transfer.download(buffer, values);
    std::copy(values.begin(), values.end(), numbers.begin());
  }
}

void VulkanState::upload_places(const gpu::Buffer& buffer,
                                std::span<const Eigen::Vector3d> vectors) {
  if (float64) {
    static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
    transfer.upload(buffer, vectors);
    return;
  }
  std::vector<float> parts(vectors.size() * 6);
  for (std::size_t v = 0; v < vectors.size(); ++v) {
    // Each component is converted separately: for whole vectors, g++ 12 omits the rounding to
    // float, and the low part would be 0.
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double exact = vectors[v][axis];
      const auto high = static_cast<float>(exact);
      float* const out = parts.data() + 6 * v + axis;
      out[0] = high;
      out[3] = static_cast<float>(exact - static_cast<double>(high));
    }
  }
  transfer.upload(buffer, parts);
}

std::vector<Eigen::Vector3d> VulkanState::download_places(const gpu::Buffer& buffer,
                                                          std::size_t count) {
  std::vector<Eigen::Vector3d> vectors(count);
  if (float64) {
    transfer.download(buffer, vectors);
    return vectors;
  }
  std::vector<float> parts(6 * count);
  transfer.download(buffer, parts);
  for (std::size_t v = 0; v < count; ++v) {
    const float* const in = parts.data() + 6 * v;
    vectors[v] = Eigen::Map<const Eigen::Vector3f>(in).cast<double>() +
                 Eigen::Map<const Eigen::Vector3f>(in + 3).cast<double>();
  }
  return vectors;
}

}  // namespace lapwing
