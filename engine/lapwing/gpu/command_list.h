#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lapwing/gpu/owned.h"

namespace lapwing::gpu {

/// Commands recorded once by a Recorder and submitted any number of times. Submitting allocates
/// nothing, so a drag frame is one `run()`. Not thread-safe. The context must outlive it; the
/// destructor waits for the list's own last submission.
class CommandList {
 public:
  /// `name` appears in error messages. The list can hold `timestamps` calls of
  /// `Recorder::timestamp`.
  CommandList(Context& context, std::string name, std::uint32_t timestamps = 0);
  ~CommandList();
  CommandList(const CommandList&) = delete;
  CommandList& operator=(const CommandList&) = delete;

  /// Submits and returns the timeline value to wait for. Lists run one after the other, and each
  /// sees the writes of earlier ones. Throws GpuError if nothing was recorded. Waits first if the
  /// list's previous submission still runs. A swapchain's semaphores may be added as in
  /// `Context::submit`.
  std::uint64_t submit(std::span<const VkSemaphoreSubmitInfo> waits = {},
                       std::span<const VkSemaphoreSubmitInfo> signals = {});
  /// Waits for this list's last submission.
  void wait() const;
  void run() {
    submit();
    wait();
  }

  /// Returns the device time between two timestamps of the last submission, which must have
  /// finished. Returns 0 on a device without timestamps.
  double milliseconds_between(std::uint32_t first, std::uint32_t second) const;

  Context& context() const { return context_; }
  const std::string& name() const { return name_; }
  VkCommandBuffer handle() const { return handle_; }

 private:
  friend class Recorder;

  struct Scope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 accesses = 0;
  };
  /// Accesses to one buffer by the commands recorded so far.
  struct History {
    VkBuffer buffer;
    Scope write;                        ///< the last write
    Scope visible;                      ///< reads that already wait for it
    VkPipelineStageFlags2 read_stages;  ///< reads since
  };

  std::uint64_t ticks_at(std::uint32_t query) const;
  void add_to_profile() const;

  Context& context_;
  std::string name_;
  Owned<VkCommandPool> pool_;
  VkCommandBuffer handle_ = VK_NULL_HANDLE;
  Owned<VkQueryPool> queries_;
  std::uint32_t timestamp_capacity_;
  /// Queries for Context::profile, after the timestamps: one before and after everything, then one
  /// before and after each dispatch, while queries last.
  std::uint32_t profile_capacity_ = 0;
  std::vector<std::string> profiled_kernels_;  ///< per dispatch, in order
  mutable bool in_profile_ = true;             ///< whether the profile includes the last submission
  std::vector<History> histories_;             ///< kept so that recording again allocates nothing
  std::uint64_t last_submission_ = 0;
  bool recorded_ = false;
};

}  // namespace lapwing::gpu
