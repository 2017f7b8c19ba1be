#include "lapwing/vulkan/ring_batch.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {

void VulkanKernels::sample_laplacians(const RingProblem& problem,
                                      std::span<Eigen::Vector3d> laplacians) {
  VulkanState& state = *state_;
  RingBatches rings(state, problem);
  const gpu::Buffer output(*state.context, "Laplacians",
                           real_bytes(state, 3 * rings.largest().row_count));
  for (const RingBatch& batch : rings.batches()) {
    rings.run(batch, state.sample_laplacians, output);
    const auto rows = laplacians.subspan(batch.first_row, batch.row_count);
    download_reals(state, output, std::span(rows.data()->data(), 3 * rows.size()));
  }
}

}  // namespace lapwing
