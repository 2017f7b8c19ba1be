#include "lapwing/gpu/recorder.h"
#include "lapwing/vulkan/reals.h"
#include "lapwing/vulkan/vulkan_ring_rotations.h"

namespace lapwing {

void VulkanRingRotations::record_fit_rotations() {
  gpu::Recorder recorder(fit_rotations_);
  for (const Range& range : ranges_) {
    recorder.dispatch(state_->fit_rotations, range.push.row_count,
                      {displacement_, range.starts, range.neighbours, range.edges, range.weights,
                       range.stiffness, row_weights_, turns_, residuals_, energies_, stretch_},
                      range.push);
  }
  recorder.finish();
}

void VulkanRingRotations::fit_rotations(std::span<const Eigen::Vector3d> displacement,
                                        std::span<double> energies) {
  if (row_count_ == 0) return;
  upload_places(*state_, displacement_, displacement);
  fit_rotations_.run();
  download_reals(*state_, energies_, energies);
}

}  // namespace lapwing
