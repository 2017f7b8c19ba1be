#include "run/bench_device.h"

#include "lapwing/gpu/context.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/vulkan/vulkan_kernels.h"

namespace lapwing::bench {

BenchDevice open_bench_device(const std::string& name, bool map_device_memory) {
  BenchDevice device;
  if (name == "cpu") {
    device.kernels = std::make_unique<CpuKernels>();
  } else {
    gpu::ContextOptions options;
    options.device = name;
    options.profile = true;
    options.map_device_memory = map_device_memory;
    device.context = std::make_shared<gpu::Context>(options);
    device.kernels = std::make_unique<VulkanKernels>(device.context, Precision::automatic);
  }
  device.name = device.kernels->device().name;
  return device;
}

}  // namespace lapwing::bench
