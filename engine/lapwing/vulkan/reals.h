#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include "lapwing/gpu/buffer.h"
#include "lapwing/vulkan/vulkan_state.h"

namespace lapwing {

/// Size and transfers of numbers in the precision of the state's kernels (shaders/precision.glsl).
std::size_t real_bytes(const VulkanState& state, std::size_t count);
void upload_reals(VulkanState& state, const gpu::Buffer& buffer, std::span<const double> numbers);
void download_reals(VulkanState& state, const gpu::Buffer& buffer, std::span<double> numbers);

/// Vectors whose differences kernels need (shaders/place.glsl): 3 doubles, or 3 floats and the
/// rounding error of each.
inline std::size_t place_bytes(std::size_t count) {
  return count * 3 * sizeof(double);
}
void upload_places(VulkanState& state, const gpu::Buffer& buffer,
                   std::span<const Eigen::Vector3d> vectors);

}  // namespace lapwing
