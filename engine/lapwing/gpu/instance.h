#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <volk.h>

#include "lapwing/gpu/devices.h"

namespace lapwing::gpu {

class Validation;

/// Opens the Vulkan loader. Throws GpuError when there is none or it knows no Vulkan 1.3.
void open_loader();

/// An instance of Vulkan 1.3, after `open_loader`; `validation` may be null. Throws GpuError,
/// saying what to install, when no driver is installed.
VkInstance create_instance(std::span<const char* const> extensions, const Validation* validation);

/// A physical device and what a context needs to know to open it.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  DeviceDescription description;
  int rank = 0;  ///< higher is preferred
  std::uint32_t queue_family = 0;
  bool has_graphics = false;
};

/// All devices, with the reason for those that lack Vulkan 1.3, a feature, one of `extensions`, or
/// a queue with compute.
std::vector<PhysicalDevice> physical_devices(VkInstance instance,
                                             std::span<const char* const> extensions);

/// The device that `wanted` (see ContextOptions::device) names. Throws GpuError, listing every
/// device and why it does not fit, when there is none.
const PhysicalDevice& select_device(std::span<const PhysicalDevice> devices,
                                    const std::string& wanted);

}  // namespace lapwing::gpu
