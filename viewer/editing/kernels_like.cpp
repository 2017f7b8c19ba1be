#include "editing/kernels_like.h"

#include "lapwing/kernels/fallback_kernels.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing::viewer {

std::function<std::unique_ptr<Kernels>()> kernels_like(
    const std::shared_ptr<gpu::Context>& context) {
  return [context]() -> std::unique_ptr<Kernels> {
    return std::make_unique<FallbackKernels>(
        [&] { return std::make_unique<VulkanKernels>(context, Precision::automatic); });
  };
}

std::function<std::shared_ptr<BlendResponse>(const DragResponse&)> upload_to(
    const std::shared_ptr<gpu::Context>& context) {
  return [context](const DragResponse& response) {
    return upload_response(context, response.columns(), response.topology());
  };
}

}  // namespace lapwing::viewer
