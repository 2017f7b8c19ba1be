#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <volk.h>

#include "lapwing/gpu/devices.h"

namespace lapwing::gpu {

class Validation;

/// Opens the Vulkan loader. Throws GpuError if the loader is missing or does not support Vulkan
/// 1.3.
void open_loader();

/// Creates an instance of Vulkan 1.3. Call `open_loader` first. `validation` may be null. Throws
/// GpuError if no driver is installed; the message lists the packages to install.
VkInstance create_instance(std::span<const char* const> extensions, const Validation* validation);

/// A physical device and the data that a context needs to open it.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceDescription description;
  int rank = 0;  ///< higher is preferred
  std::uint32_t queue_family = 0;
  bool has_graphics = false;
};

/// Returns all devices. A device is rejected, with the reason, if it lacks Vulkan 1.3, a required
/// feature, one of `extensions`, or a queue that supports compute.
std::vector<PhysicalDevice> physical_devices(VkInstance instance,
                                             std::span<const char* const> extensions);

/// Returns the device selected by `wanted` (see ContextOptions::device). Throws GpuError if there
/// is none; the message lists every device and the reason why it was not selected.
const PhysicalDevice& select_device(std::span<const PhysicalDevice> devices,
                                    const std::string& wanted);

}  // namespace lapwing::gpu
