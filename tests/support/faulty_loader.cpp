// A Vulkan loader for tests (LAPWING_VULKAN_LOADER). It passes all calls to the machine's loader,
// except that one call to the driver fails (faulty_driver.h).
#include "support/faulty_loader.h"

#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>

#include <vulkan/vulkan.h>

namespace {

using lapwing::test::DriverFault;

struct Plan {
  DriverFault fault = DriverFault::none;
  long number = 0;
  bool ever_after = false;
};

// Parses LAPWING_DRIVER_FAULT, such as "loss 3", "memory 5" or "memory 5 ever after".
Plan plan_of_environment() {
  const char* text = std::getenv("LAPWING_DRIVER_FAULT");
  if (text == nullptr) return {};
  const std::string_view words(text);
  const std::size_t space = words.find(' ');
  return {words.starts_with("loss") ? DriverFault::loss : DriverFault::memory,
          std::strtol(text + space, nullptr, 10), words.ends_with("ever after")};
}

std::mutex mutex;  // guards all variables below
Plan plan = plan_of_environment();
long calls = 0;  // of the planned kind
bool has_failed = false;
std::map<VkQueue, VkDevice> device_of;
std::set<VkDevice> lost;

void* real_function(const char* name) {
  static void* const library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  return library != nullptr ? dlsym(library, name) : nullptr;
}

template <typename Function>
Function real(const char* name) {
  return reinterpret_cast<Function>(real_function(name));
}

// Counts a call and returns whether it must fail. The caller must hold the mutex.
bool is_due(DriverFault fault) {
  if (plan.fault != fault) return false;
  const long number = calls++;
  const bool due = number == plan.number || (plan.ever_after && number > plan.number);
  has_failed = has_failed || due;
  return due;
}

bool is_lost(VkDevice device) {
  const std::lock_guard lock(mutex);
  if (lost.contains(device)) return true;
  if (!is_due(DriverFault::loss)) return false;
  real<PFN_vkDeviceWaitIdle>("vkDeviceWaitIdle")(device);
  lost.insert(device);
  return true;
}

VkDevice device_of_queue(VkQueue queue) {
  const std::lock_guard lock(mutex);
  return device_of[queue];
}

// A call that needs memory, on the device or the host.
template <int kLine, typename Function>
struct Allocation;
template <int kLine, typename... Arguments>
struct Allocation<kLine, VkResult(VKAPI_PTR*)(Arguments...)> {
  using Function = VkResult(VKAPI_PTR*)(Arguments...);
  static inline Function driver = nullptr;

  static VkResult VKAPI_PTR call(Arguments... arguments) {
    {
      const std::lock_guard lock(mutex);
      if (is_due(DriverFault::memory)) {
        return plan.number % 2 == 0 ? VK_ERROR_OUT_OF_DEVICE_MEMORY : VK_ERROR_OUT_OF_HOST_MEMORY;
      }
    }
    return driver(arguments...);
  }
};

VkResult VKAPI_PTR submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* submits,
                          VkFence fence) {
  if (is_lost(device_of_queue(queue))) return VK_ERROR_DEVICE_LOST;
  return real<PFN_vkQueueSubmit2>("vkQueueSubmit2")(queue, count, submits, fence);
}

VkResult VKAPI_PTR wait(VkDevice device, const VkSemaphoreWaitInfo* info, std::uint64_t timeout) {
  if (is_lost(device)) return VK_ERROR_DEVICE_LOST;
  return real<PFN_vkWaitSemaphores>("vkWaitSemaphores")(device, info, timeout);
}

void VKAPI_PTR get_queue(VkDevice device, std::uint32_t family, std::uint32_t index,
                         VkQueue* queue) {
  real<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(device, family, index, queue);
  const std::lock_guard lock(mutex);
  device_of[*queue] = device;
}

void VKAPI_PTR destroy_device(VkDevice device, const VkAllocationCallbacks* callbacks) {
  {
    const std::lock_guard lock(mutex);
    lost.erase(device);  // a new device may reuse the handle
  }
  real<PFN_vkDestroyDevice>("vkDestroyDevice")(device, callbacks);
}

PFN_vkVoidFunction replacement(const char* name) {
  const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
#define LAPWING_ALLOCATION(function)                             \
  if (is(#function)) {                                           \
    using Replaced = Allocation<__LINE__, PFN_##function>;       \
    Replaced::driver = real<PFN_##function>(#function);          \
    return reinterpret_cast<PFN_vkVoidFunction>(Replaced::call); \
  }
  LAPWING_ALLOCATION(vkAllocateCommandBuffers)
  LAPWING_ALLOCATION(vkAllocateDescriptorSets)
  LAPWING_ALLOCATION(vkAllocateMemory)
  LAPWING_ALLOCATION(vkBeginCommandBuffer)
  LAPWING_ALLOCATION(vkBindBufferMemory)
  LAPWING_ALLOCATION(vkBindImageMemory)
  LAPWING_ALLOCATION(vkCreateBuffer)
  LAPWING_ALLOCATION(vkCreateCommandPool)
  LAPWING_ALLOCATION(vkCreateComputePipelines)
  LAPWING_ALLOCATION(vkCreateDescriptorPool)
  LAPWING_ALLOCATION(vkCreateDescriptorSetLayout)
  LAPWING_ALLOCATION(vkCreateDevice)
  LAPWING_ALLOCATION(vkCreateGraphicsPipelines)
  LAPWING_ALLOCATION(vkCreateImage)
  LAPWING_ALLOCATION(vkCreateImageView)
  LAPWING_ALLOCATION(vkCreatePipelineLayout)
  LAPWING_ALLOCATION(vkCreateQueryPool)
  LAPWING_ALLOCATION(vkCreateSampler)
  LAPWING_ALLOCATION(vkCreateSemaphore)
  LAPWING_ALLOCATION(vkCreateShaderModule)
  LAPWING_ALLOCATION(vkEndCommandBuffer)
  LAPWING_ALLOCATION(vkMapMemory)
#undef LAPWING_ALLOCATION
  if (is("vkQueueSubmit2")) return reinterpret_cast<PFN_vkVoidFunction>(submit);
  if (is("vkWaitSemaphores")) return reinterpret_cast<PFN_vkVoidFunction>(wait);
  if (is("vkGetDeviceQueue")) return reinterpret_cast<PFN_vkVoidFunction>(get_queue);
  if (is("vkDestroyDevice")) return reinterpret_cast<PFN_vkVoidFunction>(destroy_device);
  return nullptr;
}

PFN_vkVoidFunction VKAPI_PTR device_function(VkDevice device, const char* name) {
  if (const PFN_vkVoidFunction replaced = replacement(name)) return replaced;
  return real<PFN_vkGetDeviceProcAddr>("vkGetDeviceProcAddr")(device, name);
}

}  // namespace

extern "C" {

PFN_vkVoidFunction VKAPI_PTR vkGetInstanceProcAddr(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(device_function);
  }
  if (const PFN_vkVoidFunction replaced = replacement(name)) return replaced;
  return real<PFN_vkGetInstanceProcAddr>("vkGetInstanceProcAddr")(instance, name);
}

void lapwing_fail_driver(DriverFault fault, long number, bool ever_after) {
  const std::lock_guard lock(mutex);
  plan = {fault, number, ever_after};
  calls = 0;
  has_failed = false;
}

bool lapwing_driver_has_failed() {
  const std::lock_guard lock(mutex);
  return has_failed;
}

}  // extern "C"
