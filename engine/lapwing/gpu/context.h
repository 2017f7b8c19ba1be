#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include <volk.h>

#include "lapwing/gpu/devices.h"
#include "lapwing/gpu/profile.h"

namespace lapwing::gpu {

class Validation;

struct ContextOptions {
  /// "auto" (discrete before integrated, virtual and software devices), an index of
  /// `list_devices`, or a part of a device's name in any case.
  std::string device = "auto";
  std::vector<const char*> instance_extensions =
      {};  ///< for example those of a window; added to the required extensions
  std::vector<const char*> device_extensions = {};  ///< added to the required extensions
  /// If false, device memory is never mapped, as on a discrete GPU, so that every copy is staged.
  /// Used in tests.
  bool map_device_memory = true;
  /// If true, measures the time of every command list and every dispatch, for Context::profile.
  bool profile = false;
};

/// Numbers of bytes that the host has written for the device and has read from it.
struct TransferCounts {
  std::uint64_t uploaded = 0;
  std::uint64_t downloaded = 0;
};

/// An instance, one device and one queue of Vulkan 1.3, with synchronization2, dynamic rendering,
/// timeline semaphores, push descriptors and, if the device has it, shaderFloat64. The queue
/// supports compute, and also graphics if a queue of the device supports both.
///
/// Objects created with a context refer to it and must not outlive it. `submit` and `present` may
/// be called from several threads. Contexts must be created and destroyed on one thread at a time.
class Context {
 public:
  /// The environment variable LAPWING_VALIDATION=1 turns on validation and synchronization
  /// validation. Throws GpuError if no device is suitable or the validation layers are not
  /// installed. The message lists the devices that were tried and the packages to install.
  explicit Context(const ContextOptions& options = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const DeviceDescription& description() const { return description_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  bool has_graphics() const { return has_graphics_; }
  bool maps_device_memory() const { return maps_device_memory_; }

  /// Raw handles, for Vulkan objects that this folder does not wrap (swapchains, images, graphics
  /// pipelines). Call device functions through `vk()`, for example context.vk().vkCmdDraw(...).
  const VolkDeviceTable& vk() const { return table_; }
  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical_device() const { return physical_device_; }
  VkDevice device() const { return device_; }
  VkQueue queue() const { return queue_; }
  std::uint32_t queue_family() const { return queue_family_; }

  /// Throws GpuError if `result` is an error. The message names the call, its result and the
  /// device.
  void check(VkResult result, const char* call) const;

  /// Returns the first memory type among the bits `allowed` that has all `required` and all
  /// `preferred` flags. If there is none, returns the first type with all `required` flags. Throws
  /// GpuError if no type has these.
  std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                            VkMemoryPropertyFlags preferred = 0) const;
  VkMemoryPropertyFlags memory_flags(std::uint32_t type) const;
  /// Throws GpuError if `bytes` exceeds the device's largest buffer, its largest allocation or its
  /// memory. The message contains `what`, the size and the limit.
  void check_allocation_size(VkDeviceSize bytes, const std::string& what) const;

  /// Submits recorded commands. Returns the value that the context's timeline reaches when the
  /// commands are done; it increases with every call. The semaphores of a swapchain may be added:
  /// any number of waits and up to kMaxExtraSignals signals. Does not allocate memory.
  std::uint64_t submit(VkCommandBuffer commands, std::span<const VkSemaphoreSubmitInfo> waits = {},
                       std::span<const VkSemaphoreSubmitInfo> signals = {});
  static constexpr std::size_t kMaxExtraSignals = 3;

  /// Presents the images of a swapchain between submissions. The caller must handle the result:
  /// most errors require a new swapchain.
  VkResult present(const VkPresentInfoKHR& info);
  /// Blocks until the device is idle, including presentation. Other threads cannot submit
  /// meanwhile. Use it only at shutdown, where no other call reports that a swapchain is no longer
  /// in use.
  void wait_idle() noexcept;

  /// Blocks until the timeline reaches `value`. Throws GpuError if the device is lost.
  void wait(std::uint64_t value) const;
  /// Blocks until all submissions that any thread made before this call have finished.
  void wait_for_submitted();
  /// Returns the current value of the timeline.
  std::uint64_t completed() const;

  /// Returns the number of bytes transferred so far, including those that callers have reported for
  /// mapped memory.
  TransferCounts transfers() const { return {uploaded_, downloaded_}; }
  void count_upload(std::size_t bytes) noexcept { uploaded_ += bytes; }
  void count_download(std::size_t bytes) noexcept { downloaded_ += bytes; }

  /// Returns the profile of the device's work, or null if ContextOptions::profile is false.
  Profile* profile() const { return profile_.get(); }

  bool validation_enabled() const { return validation_ != nullptr; }

 private:
  void create_instance(const ContextOptions& options);
  void create_device(const ContextOptions& options);
  void create_timeline();
  void destroy() noexcept;

  std::unique_ptr<Validation> validation_;
  std::unique_ptr<Profile> profile_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
  DeviceDescription description_;
  VkPhysicalDeviceLimits limits_{};
  VkDeviceSize max_allocation_bytes_ = 0;
  VkDeviceSize max_buffer_bytes_ = 0;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkDevice device_ = VK_NULL_HANDLE;
  VolkDeviceTable table_{};
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t queue_family_ = 0;
  bool has_graphics_ = false;
  bool maps_device_memory_;
  VkSemaphore timeline_ = VK_NULL_HANDLE;
  std::mutex submit_mutex_;
  std::uint64_t last_submitted_ = 0;
  std::atomic<std::uint64_t> uploaded_ = 0;
  std::atomic<std::uint64_t> downloaded_ = 0;
};

/// Returns the number of validation messages in this process so far, including those from destroyed
/// contexts.
std::size_t total_validation_messages();

}  // namespace lapwing::gpu
