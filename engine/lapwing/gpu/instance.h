#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <volk.h>

#include "lapwing/gpu/devices.h"

namespace lapwing::gpu {

class Validation;

/// Opens the Vulkan loader. Throws GpuError if there is none or it does not support Vulkan 1.3.
void open_loader();

/// Creates an instance of Vulkan 1.3. Call `open_loader` first. `validation` may be null. Throws
/// GpuError, saying what to install, if no driver is installed.
VkInstance create_instance(std::span<const char* const> extensions, const Validation* validation);

/// A physical device and what a context needs to open it.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceDescription description;
  int rank = 0;  ///< higher is preferred
  std::uint32_t queue_family = 0;
  bool has_graphics = false;
};

/// Returns all devices, with the reason to reject those that lack Vulkan 1.3, a feature, one of
/// `extensions`, or a queue with compute.
std::vector<PhysicalDevice> physical_devices(VkInstance instance,
                                             std::span<const char* const> extensions);

/// Returns the device that `wanted` (see ContextOptions::device) names. Throws GpuError, listing
/// every device and why it does not fit, if there is none.
const PhysicalDevice& select_device(std::span<const PhysicalDevice> devices,
                                    const std::string& wanted);

}  // namespace lapwing::gpu
