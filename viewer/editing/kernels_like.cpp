#include "editing/kernels_like.h"

#include <mutex>

#include "lapwing/kernels/fallback_kernels.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing::viewer {

std::function<std::unique_ptr<Kernels>()> kernels_like(
    const std::shared_ptr<gpu::Context>& context) {
  struct Compiled {
    std::mutex mutex;
    std::shared_ptr<const VulkanPrograms> programs;
  };
  return [context, compiled = std::make_shared<Compiled>()]() -> std::unique_ptr<Kernels> {
    return std::make_unique<FallbackKernels>([&] {
      const std::lock_guard lock(compiled->mutex);
      if (!compiled->programs) compiled->programs = compile_kernels(context, Precision::automatic);
      return std::make_unique<VulkanKernels>(compiled->programs);
    });
  };
}

std::function<std::shared_ptr<BlendResponse>(const DragResponse&)> upload_to(
    const std::shared_ptr<gpu::Context>& context) {
  return [context](const DragResponse& response) {
    return upload_response(context, response.columns(), response.topology());
  };
}

}  // namespace lapwing::viewer
