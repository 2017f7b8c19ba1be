#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/vulkan/vulkan_state.h"

namespace lapwing {

/// RingRotations on the device, in the precision of its kernels. The rings are uploaded once; an
/// iteration transfers only displacements, energies and the gradient. If the edges exceed the
/// largest buffer, the rows are split into ranges with separate buffers.
class VulkanRingRotations final : public RingRotations {
 public:
  /// A buffer contains at most `most_entries` ring entries; 0: the limit of the device. Throws
  /// GpuError if the rings do not fit in the device's memory.
  VulkanRingRotations(std::shared_ptr<VulkanState> state, const RegionRings& rings,
                      std::size_t most_entries = 0);

  void set_rest_stretch(std::span<const Eigen::Matrix3d> stretch) override;
  void fit_rotations(std::span<const Eigen::Vector3d> displacement,
                     std::span<double> energies) override;
  void energy_gradient(std::span<double> g) override;
  std::vector<Eigen::Matrix3d> transforms() const override;

  /// Records `fit_rotations` and `energy_gradient` into commands of the caller, for a buffer of
  /// displacements in the format of VulkanState::upload_places. `gradient` then contains the
  /// gradient.
  void record(gpu::Recorder& recorder, const gpu::Buffer& displacement) const;
  const gpu::Buffer& gradient() const { return result_; }

 private:
  // Push constants of shaders/rotations.glsl.
  struct Push {
    std::uint32_t row_count;
    std::uint32_t first_row;
    std::uint32_t all_rows;
    std::uint32_t unknown_count;
    std::uint32_t flags;
  };
  struct Range {
    Push push;
    gpu::Buffer starts;
    gpu::Buffer neighbours;
    gpu::Buffer edges;
    gpu::Buffer weights;
    gpu::Buffer reverse_weights;
    gpu::Buffer stiffness;
    gpu::Buffer unknowns;  ///< unknown of each row, or kNoIndex
  };
  void add_range(const RegionRings& rings, std::size_t first, std::size_t last,
                 std::span<const Index> unknown_of_row, std::uint32_t flags);
  void record_fit_rotations(gpu::Recorder& recorder, const gpu::Buffer& displacement) const;
  void record_energy_gradient(gpu::Recorder& recorder, const gpu::Buffer& displacement) const;
  void record_lists();

  std::shared_ptr<VulkanState> state_;
  std::size_t row_count_;
  std::vector<Range> ranges_;
  std::vector<Eigen::Matrix3d> rest_stretch_;  ///< per row; empty: all S_i are the identity
  gpu::Buffer row_weights_;
  gpu::Buffer stretch_;  ///< S_i - I of each row; only one row if all S_i are the identity
  gpu::Buffer displacement_;
  gpu::Buffer turns_;  ///< R_i of each row as a quaternion
  gpu::Buffer residuals_;
  gpu::Buffer energies_;
  gpu::Buffer result_;
  gpu::CommandList fit_rotations_;
  gpu::CommandList energy_gradient_;
};

}  // namespace lapwing
