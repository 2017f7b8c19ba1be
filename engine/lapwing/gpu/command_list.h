#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "lapwing/gpu/owned.h"

namespace lapwing::gpu {

/// Commands recorded once by a Recorder and submitted any number of times. Submitting does not
/// allocate memory, so a drag frame is a single call of `run`. Not thread-safe. The context must
/// outlive the list. The destructor waits for the last submission of this list.
class CommandList {
 public:
  /// `name` appears in error messages. The list has space for `timestamps` calls of
  /// Recorder::timestamp.
  CommandList(Context& context, std::string name, std::uint32_t timestamps = 0);
  ~CommandList();
  CommandList(const CommandList&) = delete;
  CommandList& operator=(const CommandList&) = delete;

  /// Submits the list and returns the timeline value to wait for. Lists run one after the other,
  /// and each sees the writes of earlier lists. If the previous submission of this list is still
  /// running, waits for it first. Throws GpuError if nothing was recorded. The semaphores of a
  /// swapchain may be added as in Context::submit.
  std::uint64_t submit(std::span<const VkSemaphoreSubmitInfo> waits = {},
                       std::span<const VkSemaphoreSubmitInfo> signals = {});
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
    Scope visible;                      ///< reads that already wait for this write
    VkPipelineStageFlags2 read_stages;  ///< stages of the reads since the last write
  };

  std::uint64_t ticks_at(std::uint32_t query) const;
  void add_to_profile() const;

  Context& context_;
  std::string name_;
  Owned<VkCommandPool> pool_;
  VkCommandBuffer handle_ = VK_NULL_HANDLE;
  Owned<VkQueryPool> queries_;
  std::uint32_t timestamp_capacity_;
  /// Number of queries for Context::profile, which follow the timestamps: one before and one after
  /// the whole list, then one before and one after each dispatch, as long as there are queries
  /// left.
  std::uint32_t profile_capacity_ = 0;
  std::vector<std::string> profiled_kernels_;  ///< kernel of each dispatch, in order
  mutable bool in_profile_ = true;             ///< true if the profile includes the last submission
  /// Reused, so that recording again allocates no memory.
  std::vector<History> histories_;
  std::uint64_t last_submission_ = 0;
  bool recorded_ = false;
};

}  // namespace lapwing::gpu
