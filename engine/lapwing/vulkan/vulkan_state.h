#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/kernel.h"
#include "lapwing/gpu/transfer.h"

namespace lapwing {

struct VulkanPrograms {
  VulkanPrograms(std::shared_ptr<gpu::Context> shared_context, bool in_float64);

  std::shared_ptr<gpu::Context> context;
  bool float64;
  gpu::Kernel assemble_rsi;
  gpu::Kernel assemble_tangent;
  gpu::Kernel energy_gradient;
  gpu::Kernel fit_rotations;
  gpu::Kernel prolongate;
  gpu::Kernel rotate_frames;
  gpu::Kernel sample_laplacians;
  gpu::Kernel sample_mapped_laplacians;
  gpu::Kernel show_displacement;
  gpu::Kernel smooth;
};

/// The state that VulkanKernels shares with its ring rotations. It transfers numbers in the
/// precision of the kernels (shaders/precision.glsl).
class VulkanState {
 public:
  VulkanState(std::shared_ptr<const VulkanPrograms> of, bool frames_on_device);

  std::size_t real_bytes(std::size_t count) const;
  void upload_reals(const gpu::Buffer& buffer, std::span<const double> numbers);
  void download_reals(const gpu::Buffer& buffer, std::span<double> numbers);

  /// Size and upload of vectors of which kernels need differences (shaders/place.glsl). Each is
  /// stored as 3 doubles, or as 3 floats and their 3 rounding errors.
  static std::size_t place_bytes(std::size_t count) { return count * 3 * sizeof(double); }
  void upload_places(const gpu::Buffer& buffer, std::span<const Eigen::Vector3d> vectors);
  std::vector<Eigen::Vector3d> download_places(const gpu::Buffer& buffer, std::size_t count);

  std::shared_ptr<const VulkanPrograms> programs;
  std::shared_ptr<gpu::Context> context;
  bool float64;
  bool frames;  ///< DeviceInfo::frames
  gpu::Transfer transfer;
};

}  // namespace lapwing
