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
      {};  ///< such as those of a window; added to those that the context needs
  std::vector<const char*> device_extensions = {};  ///< added to those that the context needs
  /// If false, device memory is never mapped, as on a discrete GPU, so that every copy is staged.
  /// For tests.
  bool map_device_memory = true;
  /// Time every command list and every dispatch, for `Context::profile`.
  bool profile = false;
};

/// Bytes that the host wrote for the device, and read from it.
struct TransferCounts {
  std::uint64_t uploaded = 0;
  std::uint64_t downloaded = 0;
};

/// An instance, one device and one queue of Vulkan 1.3, with synchronization2, dynamic rendering,
/// timeline semaphores, push descriptors and, if the device has it, shaderFloat64. The queue has
/// compute, and also graphics if any queue of the device has both.
///
/// Everything made from a context refers to it and must not outlive it. `submit` and `present` may
/// be called from several threads. Contexts must be created and destroyed on one thread at a time.
class Context {
 public:
  /// The environment variable LAPWING_VALIDATION=1 turns on validation and synchronization
  /// validation. Throws GpuError if no device fits or the validation layers are not installed. The
  /// message says what was tried and what to install.
  explicit Context(const ContextOptions& options = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const DeviceDescription& description() const { return description_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  bool has_graphics() const { return has_graphics_; }
  bool maps_device_memory() const { return maps_device_memory_; }

  /// Raw handles, for what this layer does not wrap (swapchains, images, graphics pipelines).
  /// Device functions are called through `vk()`: context.vk().vkCmdDraw(...).
  const VolkDeviceTable& vk() const { return table_; }
  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical_device() const { return physical_device_; }
  VkDevice device() const { return device_; }
  VkQueue queue() const { return queue_; }
  std::uint32_t queue_family() const { return queue_family_; }

  /// Throws GpuError, naming the call, its result and the device, if `result` is an error.
  void check(VkResult result, const char* call) const;

  /// Returns the first memory type among the bits `allowed` with all of `required` and, if there is
  /// one, all of `preferred` too. Throws GpuError if none has `required`.
  std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                            VkMemoryPropertyFlags preferred = 0) const;
  VkMemoryPropertyFlags memory_flags(std::uint32_t type) const;
  /// Throws GpuError, naming `what`, the bytes and the limit, if the device can never allocate
  /// `bytes`: more than its largest buffer, its largest allocation or its memory.
  void check_allocation_size(VkDeviceSize bytes, const std::string& what) const;

  /// Submits recorded commands and returns the value that the context's one timeline reaches when
  /// they are done. Values rise with every call. A swapchain's semaphores may be added: any number
  /// of waits, up to kMaxExtraSignals signals. Allocates nothing.
  std::uint64_t submit(VkCommandBuffer commands, std::span<const VkSemaphoreSubmitInfo> waits = {},
                       std::span<const VkSemaphoreSubmitInfo> signals = {});
  static constexpr std::size_t kMaxExtraSignals = 3;

  /// Presents a swapchain's images between submissions. The caller must handle the result: most
  /// errors ask for another swapchain.
  VkResult present(const VkPresentInfoKHR& info);
  /// Blocks until the device is idle, including the screen, while other threads cannot submit. For
  /// shutdown only, because nothing else tells when a swapchain is no longer used.
  void wait_idle() noexcept;

  /// Blocks until the timeline reaches `value`. Throws GpuError if the device is lost.
  void wait(std::uint64_t value) const;
  /// Blocks until all that any thread submitted before the call has finished.
  void wait_for_submitted();
  /// Returns the value that the timeline has reached.
  std::uint64_t completed() const;

  /// Returns the bytes of all transfers so far, with those that callers counted for mapped memory.
  TransferCounts transfers() const { return {uploaded_, downloaded_}; }
  void count_upload(std::size_t bytes) noexcept { uploaded_ += bytes; }
  void count_download(std::size_t bytes) noexcept { downloaded_ += bytes; }

  /// Returns what the device has done, or null unless the options asked for it.
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

/// Returns the number of validation messages of this process so far, including those of shutdown.
std::size_t total_validation_messages();

}  // namespace lapwing::gpu
