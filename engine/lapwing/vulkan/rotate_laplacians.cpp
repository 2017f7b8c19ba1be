#include "lapwing/gpu/recorder.h"
#include "lapwing/vulkan/reals.h"
#include "lapwing/vulkan/vulkan_ring_rotations.h"

namespace lapwing {

void VulkanRingRotations::record_rotate_laplacians() {
  gpu::Recorder recorder(rotate_laplacians_);
  for (const Range& range : ranges_) {
    recorder.dispatch(state_->rotate_laplacians, range.push.row_count,
                      {turned_, turns_, range.unknowns, range.starts, range.neighbours, range.edges,
                       range.reverse_weights, range.stiffness, result_},
                      range.push);
  }
  recorder.finish();
}

void VulkanRingRotations::rotate_laplacians(std::span<double> b) {
  if (b.empty()) return;
  rotate_laplacians_.run();
  download_reals(*state_, result_, b);
}

}  // namespace lapwing
