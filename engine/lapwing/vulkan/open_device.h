#pragma once

#include <memory>
#include <string>

#include "lapwing/kernels/kernels.h"

namespace lapwing {

namespace gpu {
class Context;
}

/// The kernels and the Vulkan context of a device.
struct Device {
  std::unique_ptr<Kernels> kernels;
  std::shared_ptr<gpu::Context> context;  ///< null if open_device() selected the CPU
  /// The reason if "auto" selected the CPU; otherwise empty.
  std::string note = {};
};

/// Opens the device `name`: "cpu", "auto", an index into `gpu::list_devices`, or part of a device's
/// name. "cpu" uses double precision and does not need Vulkan. "auto" selects the best GPU. If no
/// GPU is usable, it selects the CPU, which is faster than a software device.
///
/// If `frames_on_device` is true (see VulkanOptions), "auto" selects the best Vulkan device, even a
/// software device. If the device fails later, the kernels continue on the CPU (FallbackKernels),
/// but the context becomes unusable. Throws GpuError if no device is suitable. The message lists
/// the devices that were tried and the packages to install, and says that "cpu" always works.
Device open_device(const std::string& name, bool frames_on_device = false);

}  // namespace lapwing
