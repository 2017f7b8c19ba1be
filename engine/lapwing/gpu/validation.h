#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include <volk.h>

namespace lapwing::gpu {

/// Collects what the validation layers say of one instance. Every message goes to stderr too.
class Validation {
 public:
  /// Throws GpuError, saying what to install, when the loader finds no validation layer.
  Validation();

  static const char* layer();
  static std::vector<const char*> instance_extensions();

  /// For the pNext chain of VkInstanceCreateInfo: turns synchronization validation on and listens
  /// while the instance is made and destroyed.
  const void* instance_chain() const { return &features_; }
  void attach(VkInstance instance);
  /// Before the instance is destroyed.
  void detach(VkInstance instance) noexcept;

  std::vector<std::string> messages() const;

 private:
  static VkBool32 VKAPI_PTR receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                    const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);

  VkDebugUtilsMessengerCreateInfoEXT messenger_info_{};
  VkValidationFeaturesEXT features_{};
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

}  // namespace lapwing::gpu
