#include "lapwing/vulkan/ring_batch.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {

void VulkanKernels::assemble_rsi(const RingProblem& problem, std::span<double> blocks) {
  RingBatches(*state_, problem).assemble(state_->assemble_rsi, "RSI blocks", blocks);
}

}  // namespace lapwing
