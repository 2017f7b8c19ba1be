#pragma once

#include <memory>

#include "lapwing/gpu/context.h"
#include "lapwing/gpu/kernel.h"
#include "lapwing/gpu/transfer.h"

namespace lapwing {

/// State that VulkanKernels shares with its ring rotations.
class VulkanState {
 public:
  VulkanState(std::shared_ptr<gpu::Context> shared_context, bool in_float64,
              bool frames_on_device = false);

  std::shared_ptr<gpu::Context> context;
  bool float64;
  bool frames;  ///< as DeviceInfo::frames
  gpu::Transfer transfer;
  gpu::Kernel assemble_rsi;
  gpu::Kernel assemble_tangent;
  gpu::Kernel energy_gradient;
  gpu::Kernel fit_rotations;
  gpu::Kernel rotate_frames;
  gpu::Kernel sample_laplacians;
  gpu::Kernel sample_mapped_laplacians;
};

}  // namespace lapwing
