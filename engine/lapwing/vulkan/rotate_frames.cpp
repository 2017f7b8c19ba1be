#include "lapwing/vulkan/mapped_batch.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {
namespace {

std::span<const double> numbers_of(std::span<const Eigen::Vector3d> vectors) {
  return {vectors.empty() ? nullptr : vectors.data()->data(), 3 * vectors.size()};
}

// Returns the target's edges, in double precision. The kernel gets no target positions.
std::vector<Eigen::Vector3d> target_edges(const RegionRings& rings, const RingBatch& batch,
                                          std::span<const Eigen::Vector3d> positions) {
  std::vector<Eigen::Vector3d> edges;
  edges.reserve(batch.entry_count);
  for (std::size_t r = batch.first_row; r < batch.first_row + batch.row_count; ++r) {
    for (std::size_t e = rings.starts[r]; e < rings.starts[r + 1]; ++e) {
      edges.emplace_back(positions[rings.neighbours[e]] - positions[r]);
    }
  }
  return edges;
}

}  // namespace

void VulkanKernels::rotate_frames(const MappedRings& rings, const FramedSurface& source,
                                  const FramedSurface& target,
                                  std::span<Eigen::Matrix3d> transforms) {
  VulkanState& state = *state_;
  MappedBatches mapped(state, rings, source.positions);
  const RingBatch& largest = mapped.largest();
  const auto reals = [&](const char* name, std::size_t count) {
    return gpu::Buffer(*state.context, name, real_bytes(state, count));
  };
  const gpu::Buffer edges = reals("target edges", 3 * largest.entry_count);
  const gpu::Buffer source_normals = reals("source normals", 3 * source.normals.size());
  const gpu::Buffer target_normals = reals("target normals", 3 * largest.row_count);
  const gpu::Buffer output = reals("frames", 9 * largest.row_count);
  if (!mapped.batches().empty()) upload_reals(state, source_normals, numbers_of(source.normals));
  for (const RingBatch& batch : mapped.batches()) {
    upload_reals(state, edges, numbers_of(target_edges(rings.target, batch, target.positions)));
    upload_reals(state, target_normals,
                 numbers_of(target.normals.subspan(batch.first_row, batch.row_count)));
    mapped.run(batch, state.rotate_frames, {edges, source_normals, target_normals, output});
    const auto rows = transforms.subspan(batch.first_row, batch.row_count);
    download_reals(state, output, std::span(rows.data()->data(), 9 * rows.size()));
  }
}

}  // namespace lapwing
