#include "lapwing/gpu/context.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/instance.h"
#include "lapwing/gpu/results.h"
#include "lapwing/gpu/validation.h"

namespace lapwing::gpu {
namespace {

bool validation_in_environment() {
  const char* value = std::getenv("LAPWING_VALIDATION");
  return value != nullptr && std::strcmp(value, "1") == 0;
}

std::vector<const char*> device_extensions(const ContextOptions& options) {
  std::vector<const char*> extensions{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};
  extensions.insert(extensions.end(), options.device_extensions.begin(),
                    options.device_extensions.end());
  return extensions;
}

}  // namespace

std::vector<DeviceDescription> list_devices() {
  open_loader();
  const VkInstance instance = create_instance({}, nullptr);
  std::vector<DeviceDescription> list;
  try {
    for (PhysicalDevice& device : physical_devices(instance, device_extensions({}))) {
      list.push_back(std::move(device.description));
    }
  } catch (...) {
    vkDestroyInstance(instance, nullptr);
    throw;
  }
  vkDestroyInstance(instance, nullptr);
  return list;
}

Context::Context(const ContextOptions& options)
    : profile_(options.profile ? std::make_unique<Profile>() : nullptr),
      maps_device_memory_(options.map_device_memory) {
  try {
    create_instance(options);
    create_device(options);
    create_timeline();
  } catch (...) {
    destroy();
    throw;
  }
}

Context::~Context() {
  destroy();
}

void Context::create_instance(const ContextOptions& options) {
  open_loader();
  if (validation_in_environment()) validation_ = std::make_unique<Validation>();
  instance_ = gpu::create_instance(options.instance_extensions, validation_.get());
  if (validation_) validation_->attach(instance_);
}

void Context::create_device(const ContextOptions& options) {
  const auto extensions = device_extensions(options);
  const auto devices = physical_devices(instance_, extensions);
  const PhysicalDevice& chosen = select_device(devices, options.device);
  physical_device_ = chosen.handle;
  description_ = chosen.description;
  queue_family_ = chosen.queue_family;
  has_graphics_ = chosen.has_graphics;

  VkPhysicalDeviceVulkan13Properties v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES};
  VkPhysicalDeviceVulkan11Properties v11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
                                         &v13};
  VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &v11};
  vkGetPhysicalDeviceProperties2(physical_device_, &properties);
  limits_ = properties.properties.limits;
  max_allocation_bytes_ = v11.maxMemoryAllocationSize;
  max_buffer_bytes_ = v13.maxBufferSize;
  vkGetPhysicalDeviceMemoryProperties(physical_device_, &memory_);

  VkPhysicalDeviceVulkan13Features f13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  f13.synchronization2 = VK_TRUE;
  f13.dynamicRendering = VK_TRUE;
  VkPhysicalDeviceVulkan12Features f12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &f13};
  f12.timelineSemaphore = VK_TRUE;
  const float priority = 1.0F;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = queue_family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkPhysicalDeviceFeatures enabled{};
  enabled.shaderFloat64 = description_.float64 ? VK_TRUE : VK_FALSE;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &f12};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  info.pEnabledFeatures = &enabled;
  check(vkCreateDevice(physical_device_, &info, nullptr, &device_), "vkCreateDevice");
  volkLoadDeviceTable(&table_, device_);
  table_.vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
}

void Context::create_timeline() {
  VkSemaphoreTypeCreateInfo type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO};
  type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
  const VkSemaphoreCreateInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &type};
  check(table_.vkCreateSemaphore(device_, &info, nullptr, &timeline_), "vkCreateSemaphore");
}

void Context::destroy() noexcept {
  if (device_ != VK_NULL_HANDLE) {
    table_.vkDeviceWaitIdle(device_);
    if (timeline_ != VK_NULL_HANDLE) table_.vkDestroySemaphore(device_, timeline_, nullptr);
    table_.vkDestroyDevice(device_, nullptr);
  }
  if (instance_ == VK_NULL_HANDLE) return;
  if (validation_) validation_->detach(instance_);
  vkDestroyInstance(instance_, nullptr);
}

void Context::check(VkResult result, const char* call) const {
  check_result(result, call, description_.name);
}

std::uint32_t Context::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                   VkMemoryPropertyFlags preferred) const {
  for (const VkMemoryPropertyFlags flags : {required | preferred, required}) {
    for (std::uint32_t type = 0; type < memory_.memoryTypeCount; ++type) {
      if ((allowed >> type & 1U) != 0 && (memory_flags(type) & flags) == flags) return type;
    }
  }
  throw GpuError(description_.name + " has no memory type with the flags " +
                 std::to_string(required) + " for this resource; choose another device");
}

VkMemoryPropertyFlags Context::memory_flags(std::uint32_t type) const {
  return memory_.memoryTypes[type].propertyFlags;
}

void Context::check_allocation_size(VkDeviceSize bytes, const std::string& what) const {
  VkDeviceSize largest_heap = 0;
  for (std::uint32_t heap = 0; heap < memory_.memoryHeapCount; ++heap) {
    largest_heap = std::max(largest_heap, memory_.memoryHeaps[heap].size);
  }
  const VkDeviceSize limit = std::min({max_buffer_bytes_, max_allocation_bytes_, largest_heap});
  if (bytes <= limit) return;
  throw GpuError(what + " needs " + std::to_string(bytes) + " bytes, but " + description_.name +
                 " allows " + std::to_string(limit) +
                 " at once; choose a smaller region, or run with --device cpu");
}

std::uint64_t Context::submit(VkCommandBuffer commands,
                              std::span<const VkSemaphoreSubmitInfo> waits,
                              std::span<const VkSemaphoreSubmitInfo> signals) {
  if (signals.size() > kMaxExtraSignals) {
    throw GpuError("a submission signals at most " + std::to_string(kMaxExtraSignals) +
                   " semaphores besides the timeline");
  }
  std::array<VkSemaphoreSubmitInfo, kMaxExtraSignals + 1> all_signals{};
  std::copy(signals.begin(), signals.end(), all_signals.begin() + 1);
  VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  buffer.commandBuffer = commands;
  VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  info.waitSemaphoreInfoCount = static_cast<std::uint32_t>(waits.size());
  info.pWaitSemaphoreInfos = waits.data();
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &buffer;
  info.signalSemaphoreInfoCount = static_cast<std::uint32_t>(signals.size() + 1);
  info.pSignalSemaphoreInfos = all_signals.data();

  const std::scoped_lock lock(submit_mutex_);
  all_signals[0].sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
  all_signals[0].semaphore = timeline_;
  all_signals[0].value = last_submitted_ + 1;
  all_signals[0].stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  check(table_.vkQueueSubmit2(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
  return ++last_submitted_;
}

VkResult Context::present(const VkPresentInfoKHR& info) {
  const std::scoped_lock lock(submit_mutex_);
  return table_.vkQueuePresentKHR(queue_, &info);
}

void Context::wait_idle() noexcept {
  const std::scoped_lock lock(submit_mutex_);
  table_.vkDeviceWaitIdle(device_);
}

void Context::wait(std::uint64_t value) const {
  VkSemaphoreWaitInfo info{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO};
  info.semaphoreCount = 1;
  info.pSemaphores = &timeline_;
  info.pValues = &value;
  check(table_.vkWaitSemaphores(device_, &info, std::numeric_limits<std::uint64_t>::max()),
        "vkWaitSemaphores");
}

void Context::wait_for_submitted() {
  std::uint64_t last = 0;
  {
    const std::scoped_lock lock(submit_mutex_);
    last = last_submitted_;
  }
  wait(last);
}

std::uint64_t Context::completed() const {
  std::uint64_t value = 0;
  check(table_.vkGetSemaphoreCounterValue(device_, timeline_, &value),
        "vkGetSemaphoreCounterValue");
  return value;
}

}  // namespace lapwing::gpu
