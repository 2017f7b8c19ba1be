#include "lapwing/gpu/devices.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/instance.h"
#include "lapwing/gpu/results.h"

namespace lapwing::gpu {
namespace {

struct TypeRank {
  const char* name;
  int rank;
};

TypeRank type_of(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return {"discrete GPU", 4};
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return {"integrated GPU", 3};
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return {"virtual GPU", 2};
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return {"software", 1};
    default:
      return {"other", 0};
  }
}

std::string version_text(std::uint32_t version) {
  return std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
         std::to_string(VK_API_VERSION_MINOR(version)) + "." +
         std::to_string(VK_API_VERSION_PATCH(version));
}

std::vector<VkExtensionProperties> extensions_of(VkPhysicalDevice device, const std::string& name) {
  std::uint32_t count = 0;
  check_result(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
               "vkEnumerateDeviceExtensionProperties", name);
  std::vector<VkExtensionProperties> list(count);
  check_result(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, list.data()),
               "vkEnumerateDeviceExtensionProperties", name);
  return list;
}

std::string missing_extension(const PhysicalDevice& device,
                              std::span<const char* const> extensions) {
  const auto available = extensions_of(device.handle, device.description.name);
  for (const char* wanted : extensions) {
    const bool found = std::any_of(available.begin(), available.end(), [&](const auto& extension) {
      return std::strcmp(extension.extensionName, wanted) == 0;
    });
    if (!found) return wanted;
  }
  return {};
}

// Requires Vulkan 1.3, because earlier versions do not have these structures.
std::string missing_feature(VkPhysicalDevice device) {
  VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &v13};
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &v12};
  vkGetPhysicalDeviceFeatures2(device, &features);
  if (v12.timelineSemaphore == VK_FALSE) return "timelineSemaphore";
  if (v13.synchronization2 == VK_FALSE) return "synchronization2";
  if (v13.dynamicRendering == VK_FALSE) return "dynamicRendering";
  return {};
}

// Prefers a family that also supports graphics, so that the renderer can share the queue.
bool find_queue_family(PhysicalDevice& device) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device.handle, &count, families.data());
  bool found = false;
  for (std::uint32_t f = 0; f < count; ++f) {
    const VkQueueFlags flags = families[f].queueFlags;
    if ((flags & VK_QUEUE_COMPUTE_BIT) == 0) continue;
    const bool graphics = (flags & VK_QUEUE_GRAPHICS_BIT) != 0;
    if (found && !(graphics && !device.has_graphics)) continue;
    found = true;
    device.queue_family = f;
    device.has_graphics = graphics;
  }
  return found;
}

PhysicalDevice describe(VkPhysicalDevice handle, std::size_t index) {
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &driver};
  vkGetPhysicalDeviceProperties2(handle, &properties);
  VkPhysicalDeviceFeatures features;
  vkGetPhysicalDeviceFeatures(handle, &features);

  PhysicalDevice device;
  device.handle = handle;
  device.rank = type_of(properties.properties.deviceType).rank;
  device.description.index = index;
  device.description.name = properties.properties.deviceName;
  device.description.type = type_of(properties.properties.deviceType).name;
  device.description.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  device.description.api_version = version_text(properties.properties.apiVersion);
  device.description.float64 = features.shaderFloat64 != VK_FALSE;
  if (properties.properties.apiVersion < VK_API_VERSION_1_3) {
    device.description.rejected =
        "Vulkan " + device.description.api_version + " is older than 1.3; update its driver";
  }
  return device;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool names(const std::string& wanted, const DeviceDescription& device) {
  if (wanted == "auto") return true;
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (error == std::errc() && end == wanted.data() + wanted.size()) return index == device.index;
  return lower(device.name).find(lower(wanted)) != std::string::npos;
}

std::string listing(std::span<const PhysicalDevice> devices) {
  std::string text;
  for (const PhysicalDevice& device : devices) {
    const DeviceDescription& d = device.description;
    text += (text.empty() ? "" : ", ") + std::to_string(d.index) + ": " + d.name + " (" + d.type +
            ", " + (d.rejected.empty() ? "usable" : d.rejected) + ")";
  }
  return text.empty() ? "none" : text;
}

}  // namespace

std::vector<PhysicalDevice> physical_devices(VkInstance instance,
                                             std::span<const char* const> extensions) {
  std::uint32_t count = 0;
  check_result(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices",
               "the Vulkan loader");
  std::vector<VkPhysicalDevice> handles(count);
  check_result(vkEnumeratePhysicalDevices(instance, &count, handles.data()),
               "vkEnumeratePhysicalDevices", "the Vulkan loader");
  std::vector<PhysicalDevice> devices;
  for (const VkPhysicalDevice handle : handles) {
    PhysicalDevice device = describe(handle, devices.size());
    std::string& rejected = device.description.rejected;
    if (rejected.empty()) {
      if (const auto missing = missing_feature(handle); !missing.empty()) {
        rejected = "lacks the feature " + missing;
      } else if (const auto lacks = missing_extension(device, extensions); !lacks.empty()) {
        rejected = "lacks the extension " + lacks;
      } else if (!find_queue_family(device)) {
        rejected = "has no queue for compute";
      }
    }
    devices.push_back(std::move(device));
  }
  return devices;
}

const PhysicalDevice& select_device(std::span<const PhysicalDevice> devices,
                                    const std::string& wanted) {
  const PhysicalDevice* best = nullptr;
  for (const PhysicalDevice& device : devices) {
    if (!device.description.rejected.empty() || !names(wanted, device.description)) continue;
    if (best == nullptr || device.rank > best->rank) best = &device;
  }
  if (best == nullptr) {
    throw GpuError("no usable Vulkan device matches \"" + wanted +
                   "\"; devices found: " + listing(devices) +
                   "; name one of the usable ones, install mesa-vulkan-drivers for software "
                   "rendering, or run with --device cpu");
  }
  return *best;
}

}  // namespace lapwing::gpu
