#include "lapwing/gpu/recorder.h"
#include "lapwing/vulkan/reals.h"
#include "lapwing/vulkan/vulkan_ring_rotations.h"

namespace lapwing {

void VulkanRingRotations::record_energy_gradient() {
  gpu::Recorder recorder(energy_gradient_);
  for (const Range& range : ranges_) {
    recorder.dispatch(
        state_->energy_gradient, range.push.row_count,
        {displacement_, residuals_, turns_, range.unknowns, range.starts, range.neighbours,
         range.edges, range.reverse_weights, range.stiffness, result_, stretch_},
        range.push);
  }
  recorder.finish();
}

void VulkanRingRotations::energy_gradient(std::span<double> g) {
  if (g.empty()) return;
  energy_gradient_.run();
  download_reals(*state_, result_, g);
}

}  // namespace lapwing
