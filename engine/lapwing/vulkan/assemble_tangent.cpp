#include "lapwing/vulkan/ring_batch.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {

void VulkanKernels::assemble_tangent(const EnergyProblem& problem, std::span<double> blocks) {
  RingBatches(*state_, problem).assemble(state_->assemble_tangent, "tangent blocks", blocks);
}

}  // namespace lapwing
