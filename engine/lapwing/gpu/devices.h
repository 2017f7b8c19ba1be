#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"

namespace lapwing::gpu {

/// Thrown if the driver has lost the device. Objects created with its context can then only be
/// destroyed. A new context can open the device again.
class DeviceLost : public GpuError {
 public:
  using GpuError::GpuError;
};

/// A physical device as the Vulkan loader reports it.
struct DeviceDescription {
  std::size_t index = 0;  ///< index in `list_devices`
  std::string name;       ///< for example "llvmpipe (LLVM 15.0.6, 256 bits)"
  std::string type;       ///< "discrete GPU", "integrated GPU", "virtual GPU", "software", "other"
  std::string driver;     ///< name and version
  std::string api_version;  ///< for example "1.3.230"
  bool float64 = false;     ///< shaderFloat64
  std::string rejected;     ///< the reason why the device cannot be used; empty for a usable device
};

/// Returns all devices, including unusable ones. Throws GpuError if the Vulkan loader cannot be
/// opened or no driver is installed. The message gives the file that was tried and the packages to
/// install. The loader is libvulkan.so.1, or the file named by the environment variable
/// LAPWING_VULKAN_LOADER.
std::vector<DeviceDescription> list_devices();

}  // namespace lapwing::gpu
