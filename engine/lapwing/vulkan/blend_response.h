#pragma once

#include <span>
#include <vector>

#include "lapwing/gpu/recorder.h"
#include "lapwing/gpu/texel_buffer.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/vulkan/host_frame.h"
#include "lapwing/vulkan/vulkan_state.h"

namespace lapwing {

/// Kernel blend_response over one basis, kept on the device in float32. Vertices are split into
/// ranges, each with buffers of its own, where the basis has more texels than a buffer may.
class BlendResponse {
 public:
  /// Positions are relative to `origin`. `most_texels` in one buffer; the device's limit if 0.
  /// Throws GpuError when the basis does not fit in the device's memory.
  BlendResponse(VulkanState& state, const SurfaceInput& input, const Eigen::Vector3d& origin,
                std::size_t most_texels = 0);

  /// As DeformedSurface. The device must be done with the recorded commands.
  void set_basis(std::span<const double> basis);
  void set_axis_basis(std::span<const double> numbers);
  void set_rest(std::span<const Eigen::Vector3d> positions);

  /// Records the blend into `positions`, one vec4 per vertex of the mesh, whose w stays: 1.
  void record(gpu::Recorder& recorder, const gpu::Buffer& positions) const;
  /// Does now, on the processor, what the recorded commands would. Everything must be mapped.
  void run_on_host(std::span<Vec4> positions) const;
  /// What the recorded commands use when they next run: one number per column. The device must be
  /// done with them. Throws InputError when the number is wrong.
  void set_parameters(std::span<const double> parameters);

 private:
  struct Range {
    std::size_t first;
    std::size_t count;
    gpu::TexelBuffer moving;
    gpu::TexelBuffer rests;
    gpu::TexelBuffer basis;
  };
  template <typename Pack>
  void fill(const Pack& pack);
  void add_range(std::size_t first, std::size_t count);

  VulkanState& state_;
  std::size_t columns_;
  std::vector<Index> moving_;
  Eigen::Vector3d origin_;
  gpu::Buffer groups_;
  std::vector<Range> ranges_;
};

}  // namespace lapwing
