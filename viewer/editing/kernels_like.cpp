#include "editing/kernels_like.h"

namespace lapwing::viewer {

std::function<std::unique_ptr<Kernels>()> kernels_like(const VulkanKernels& kernels) {
  return [context = kernels.context()]() -> std::unique_ptr<Kernels> {
    return std::make_unique<VulkanKernels>(context, Precision::automatic);
  };
}

}  // namespace lapwing::viewer
