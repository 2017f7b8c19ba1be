#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"

namespace lapwing::gpu {

/// The driver lost the device. Everything made from its context can only be destroyed. A new
/// context may open the device again.
class DeviceLost : public GpuError {
 public:
  using GpuError::GpuError;
};

/// A physical device as the Vulkan loader reports it.
struct DeviceDescription {
  std::size_t index = 0;  ///< in `list_devices`
  std::string name;       ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string type;       ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "other"
  std::string driver;     ///< driver name and version
  std::string api_version;  ///< "1.3.230"
  bool float64 = false;     ///< shaderFloat64
  std::string rejected;     ///< why it cannot be used; empty for a usable device
};

/// Returns every device, usable or not. Throws GpuError, saying what was tried and what to install,
/// if the Vulkan loader cannot be opened or no driver is installed. The loader is libvulkan.so.1,
/// or the file that LAPWING_VULKAN_LOADER names in the environment.
std::vector<DeviceDescription> list_devices();

}  // namespace lapwing::gpu
