#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "lapwing/vulkan/ring_batch.h"

namespace lapwing {

/// MappedRings on the device, one batch of rows at a time (layout: shaders/mapped_ring.glsl). The
/// source and the points are uploaded once, the rings for each batch.
class MappedBatches {
 public:
  /// `source` has one vector per source vertex. The kernels use differences of these vectors.
  MappedBatches(VulkanState& state, const MappedRings& rings,
                std::span<const Eigen::Vector3d> source);

  const std::vector<RingBatch>& batches() const { return batches_; }
  const RingBatch& largest() const { return largest_; }
  /// Returns the first entry of a batch in RegionRings.
  std::size_t first_entry(const RingBatch& batch) const {
    return rings_.target.starts[batch.first_row];
  }

  /// Uploads the rings of `batch`, runs `kernel` on the batch and waits. `others` are the buffers
  /// bound after those of mapped_ring.glsl. `flag` is the last push constant.
  void run(const RingBatch& batch, const gpu::Kernel& kernel,
           std::initializer_list<gpu::BufferRange> others, bool flag = false);

 private:
  void upload_points();
  void upload_rings(const RingBatch& batch);

  VulkanState& state_;
  const MappedRings& rings_;
  std::vector<RingBatch> batches_;
  RingBatch largest_;
  gpu::Buffer source_;
  gpu::Buffer corners_;
  gpu::Buffer point_weights_;
  gpu::Buffer starts_;
  gpu::Buffer neighbours_;
  gpu::CommandList commands_;
};

}  // namespace lapwing
