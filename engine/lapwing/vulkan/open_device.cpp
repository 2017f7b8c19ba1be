#include "lapwing/vulkan/open_device.h"

#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {

Device open_device(const std::string& name, bool frames_on_device) {
  if (name == "cpu") return {std::make_unique<CpuKernels>(), nullptr};
  try {
    VulkanOptions options;
    options.device = name;
    options.frames_on_device = frames_on_device;
    auto kernels = std::make_unique<VulkanKernels>(options);
    auto context = kernels->context();
    return {std::move(kernels), std::move(context)};
  } catch (const GpuError& error) {
    throw GpuError(std::string(error.what()) +
                   "; without Vulkan, `--device cpu` runs the same edit on the CPU");
  }
}

}  // namespace lapwing
