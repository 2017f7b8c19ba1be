#pragma once

#include <memory>
#include <string>

#include "lapwing/kernels/kernels.h"

namespace lapwing {

namespace gpu {
class Context;
}

/// What computes, and where pictures can be drawn.
struct Device {
  std::unique_ptr<Kernels> kernels;
  std::shared_ptr<gpu::Context> context;  ///< null without Vulkan
};

/// The device that `name` asks for: "cpu" (double precision, no Vulkan needed), "auto" (the best
/// Vulkan device), an index of `gpu::list_devices`, or a part of a device's name.
/// `frames_on_device` as in VulkanOptions. The kernels go on where the device fails later
/// (FallbackKernels); its context does not.
/// Throws GpuError saying what was tried, what to install, and that "cpu" always works.
Device open_device(const std::string& name, bool frames_on_device = false);

}  // namespace lapwing
