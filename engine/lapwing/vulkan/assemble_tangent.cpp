#include "lapwing/vulkan/ring_batch.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {

void VulkanKernels::assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) {
  constexpr std::size_t kNumbersPerBlock = 9;
  VulkanState& state = *state_;
  RingBatches rings(state, problem);
  const gpu::Buffer output(*state.context, "tangent blocks",
                           real_bytes(state, kNumbersPerBlock * rings.largest().block_count()));
  std::size_t written = 0;
  for (const RingBatch& batch : rings.batches()) {
    rings.run(batch, state.assemble_tangent, output);
    const std::size_t numbers = kNumbersPerBlock * batch.block_count();
    download_reals(state, output, blocks.subspan(written, numbers));
    written += numbers;
  }
}

}  // namespace lapwing
