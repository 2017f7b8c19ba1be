#pragma once

#include <memory>
#include <string>

#include "lapwing/kernels/kernels.h"

namespace lapwing {

namespace gpu {
class Context;
}

/// The kernels, and the Vulkan context for drawing.
struct Device {
  std::unique_ptr<Kernels> kernels;
  std::shared_ptr<gpu::Context> context;  ///< null without Vulkan
};

/// Opens the device `name`: "cpu" (double precision, no Vulkan needed), "auto" (the best Vulkan
/// device), an index of `gpu::list_devices`, or part of a device's name. `frames_on_device` as in
/// VulkanOptions. If the device fails later, the kernels continue on the CPU (FallbackKernels), but
/// the context does not. Throws GpuError saying what was tried, what to install, and that "cpu"
/// always works.
Device open_device(const std::string& name, bool frames_on_device = false);

}  // namespace lapwing
