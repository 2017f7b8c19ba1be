#include "lapwing/gpu/validation.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/results.h"

namespace lapwing::gpu {
namespace {

constexpr std::array kEnabled{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};

// Number of messages in the whole process, because messages about leaked objects arrive while a
// context is destroyed.
std::atomic<std::size_t> total_messages{0};

bool layer_is_installed() {
  std::uint32_t count = 0;
  check_result(vkEnumerateInstanceLayerProperties(&count, nullptr),
               "vkEnumerateInstanceLayerProperties", "the Vulkan loader");
  std::vector<VkLayerProperties> layers(count);
  check_result(vkEnumerateInstanceLayerProperties(&count, layers.data()),
               "vkEnumerateInstanceLayerProperties", "the Vulkan loader");
  for (const VkLayerProperties& layer : layers) {
    if (std::strcmp(layer.layerName, Validation::layer()) == 0) return true;
  }
  return false;
}

}  // namespace

std::size_t total_validation_messages() {
  return total_messages;
}

const char* Validation::layer() {
  return "VK_LAYER_KHRONOS_validation";
}

std::vector<const char*> Validation::instance_extensions() {
  return {VK_EXT_DEBUG_UTILS_EXTENSION_NAME, VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME};
}

Validation::Validation() {
  if (!layer_is_installed()) {
    throw GpuError(std::string("validation was asked for, but the Vulkan loader finds no ") +
                   layer() +
                   "; install vulkan-validationlayers, or run without LAPWING_VALIDATION");
  }
  messenger_info_.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  messenger_info_.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                    VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // General messages are excluded. They come from the loader and concern the configuration of the
  // machine.
  messenger_info_.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  messenger_info_.pfnUserCallback = &Validation::receive;

  features_.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features_.pNext = &messenger_info_;
  features_.enabledValidationFeatureCount = static_cast<std::uint32_t>(kEnabled.size());
  features_.pEnabledValidationFeatures = kEnabled.data();
}

void Validation::attach(VkInstance instance) {
  // Do not use volk's global function pointers. They belong to the newest instance, which may have
  // no messenger.
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
  check_result(create(instance, &messenger_info_, nullptr, &messenger_),
               "vkCreateDebugUtilsMessengerEXT", "the Vulkan loader");
}

void Validation::detach(VkInstance instance) noexcept {
  if (messenger_ == VK_NULL_HANDLE) return;
  const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance, "vkDestroyDebugUtilsMessengerEXT"));
  destroy(instance, messenger_, nullptr);
  messenger_ = VK_NULL_HANDLE;
}

VkBool32 Validation::receive(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                             VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                             const VkDebugUtilsMessengerCallbackDataEXT* data, void* /*user*/) {
  std::fprintf(stderr, "Vulkan validation: %s\n", data->pMessage);
  ++total_messages;
  return VK_FALSE;
}

}  // namespace lapwing::gpu
