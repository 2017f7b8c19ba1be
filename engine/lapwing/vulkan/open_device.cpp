#include "lapwing/vulkan/open_device.h"

#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/kernels/fallback_kernels.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {
namespace {

std::shared_ptr<gpu::Context> open_context(const std::string& name) {
  try {
    gpu::ContextOptions options;
    options.device = name;
    return std::make_shared<gpu::Context>(options);
  } catch (const GpuError& error) {
    throw GpuError(std::string(error.what()) +
                   "; without Vulkan, `--device cpu` runs the same edit on the CPU");
  }
}

}  // namespace

Device open_device(const std::string& name, bool frames_on_device) {
  if (name == "cpu") return {std::make_unique<CpuKernels>(), nullptr};
  auto context = open_context(name);
  auto kernels = std::make_unique<FallbackKernels>([&] {
    return std::make_unique<VulkanKernels>(context, Precision::automatic, frames_on_device);
  });
  return {std::move(kernels), std::move(context)};
}

}  // namespace lapwing
