#pragma once

#include <vector>

#include <volk.h>

namespace lapwing::gpu {

/// Prints the validation messages of one Vulkan instance to stderr and counts them.
class Validation {
 public:
  /// Throws GpuError if the loader finds no validation layer; the message names the package to
  /// install.
  Validation();

  static const char* layer();
  static std::vector<const char*> instance_extensions();

  /// Returns the pNext chain of VkInstanceCreateInfo. It turns on synchronization validation and
  /// collects messages while the instance is created and destroyed.
  const void* instance_chain() const { return &features_; }
  void attach(VkInstance instance);
  /// Call this before the instance is destroyed.
  void detach(VkInstance instance) noexcept;

 private:
  static VkBool32 VKAPI_PTR receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* user);

  VkDebugUtilsMessengerCreateInfoEXT messenger_info_{};
  VkValidationFeaturesEXT features_{};
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
};

}  // namespace lapwing::gpu
