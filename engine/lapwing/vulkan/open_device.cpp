#include "lapwing/vulkan/open_device.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/kernels/fallback_kernels.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing {
namespace {

std::shared_ptr<gpu::Context> open_context(const std::string& name) {
  try {
    return std::make_shared<gpu::Context>(gpu::ContextOptions{.device = name});
  } catch (const GpuError& error) {
    throw GpuError(std::string(error.what()) +
                   "; without Vulkan, `--device cpu` runs the same edit on the CPU");
  }
}

// Returns the reason if "auto" selects the CPU, or an empty string if a GPU is usable.
std::string why_no_gpu() {
  std::vector<gpu::DeviceDescription> devices;
  try {
    devices = gpu::list_devices();
  } catch (const GpuError&) {
    return "The CPU computes, because Vulkan finds no device. `lapwing info` says why.";
  }
  std::erase_if(devices, [](const auto& device) { return !device.rejected.empty(); });
  if (devices.empty()) {
    return "The CPU computes, because no Vulkan device is usable. `lapwing info` says why.";
  }
  const auto is_gpu = [](const auto& device) { return device.type != "software"; };
  if (std::ranges::any_of(devices, is_gpu)) return {};
  return "The CPU computes, because the only Vulkan device is a software one (" +
         devices.front().name + "), which is slower. `--device " +
         std::to_string(devices.front().index) + "` uses it.";
}

}  // namespace

Device open_device(const std::string& name, bool frames_on_device) {
  if (name == "cpu") return {std::make_unique<CpuKernels>(), nullptr};
  if (name == "auto" && !frames_on_device) {
    if (std::string why = why_no_gpu(); !why.empty()) {
      return {std::make_unique<CpuKernels>(), nullptr, std::move(why)};
    }
  }
  auto context = open_context(name);
  auto kernels = std::make_unique<FallbackKernels>([&] {
    return std::make_unique<VulkanKernels>(context, Precision::automatic, frames_on_device);
  });
  return {std::move(kernels), std::move(context)};
}

}  // namespace lapwing
