#include "lapwing/vulkan/mapped_batch.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {

void VulkanKernels::sample_mapped_laplacians(const MappedRings& rings, MappedSampling sampling,
                                             std::span<const Eigen::Vector3d> source,
                                             std::span<Eigen::Vector3d> laplacians) {
  VulkanState& state = *state_;
  MappedBatches mapped(state, rings, source);
  const RingBatch& largest = mapped.largest();
  const gpu::Buffer weights(*state.context, "weights", real_bytes(state, largest.entry_count));
  const gpu::Buffer output(*state.context, "Laplacians", real_bytes(state, 3 * largest.row_count));
  for (const RingBatch& batch : mapped.batches()) {
    const auto all_weights = std::span(rings.target.weights);
    upload_reals(state, weights, all_weights.subspan(mapped.first_entry(batch), batch.entry_count));
    mapped.run(batch, state.sample_mapped_laplacians, {weights, output},
               sampling == MappedSampling::linear);
    const auto rows = laplacians.subspan(batch.first_row, batch.row_count);
    download_reals(state, output, std::span(rows.data()->data(), 3 * rows.size()));
  }
}

}  // namespace lapwing
