#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/vulkan/vulkan_state.h"

namespace lapwing {

/// Consecutive rows of a RingProblem or of MappedRings.
struct RingBatch {
  std::size_t first_row = 0;
  std::size_t row_count = 0;
  std::size_t entry_count = 0;  ///< ring entries of these rows

  /// Returns the number of blocks in these rows of M: one for each row and each ring entry.
  std::size_t block_count() const { return row_count + entry_count; }
};

/// Splits the rows 0 to row_count - 1 into a few batches whose buffers are far below the limits of
/// every device. `entries_of` returns the size of a row's ring.
std::vector<RingBatch> split_rows(std::size_t row_count,
                                  const std::function<std::size_t(std::size_t)>& entries_of);
/// Returns the maximum of each member over all batches.
RingBatch largest_of(std::span<const RingBatch> batches);

/// A RingProblem on the device, one batch of rows at a time (layout: shaders/ring.glsl), so that
/// input and output need little memory for any number of rows.
class RingBatches {
 public:
  RingBatches(VulkanState& state, const RingProblem& problem);
  /// Adds row weights and stiffness as buffers after the output.
  RingBatches(VulkanState& state, const EnergyProblem& problem);

  const std::vector<RingBatch>& batches() const { return batches_; }
  const RingBatch& largest() const { return largest_; }

  /// Runs `kernel`, which writes a 3 x 3 block for each row and each ring entry, on all batches
  /// (see Kernels::assemble_rsi and assemble_tangent).
  void assemble(const gpu::Kernel& kernel, const char* name, std::span<double> blocks);

  /// Uploads `batch`, runs `kernel` on it and waits. `output` is bound after the buffers of
  /// ring.glsl and before those of the energy.
  void run(const RingBatch& batch, const gpu::Kernel& kernel, const gpu::Buffer& output);

 private:
  void upload_rows(const RingBatch& batch);
  void upload_energy(const RingBatch& batch);

  VulkanState& state_;
  const RingProblem& problem_;
  const EnergyProblem* energy_ = nullptr;
  std::vector<RingBatch> batches_;
  RingBatch largest_;
  gpu::Buffer positions_;
  gpu::Buffer rows_;
  gpu::Buffer starts_;
  gpu::Buffer neighbours_;
  gpu::Buffer weights_;
  std::vector<gpu::Buffer> energy_buffers_;  ///< row weights and stiffness, or none
  gpu::CommandList commands_;
};

}  // namespace lapwing
