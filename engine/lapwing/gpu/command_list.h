#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <volk.h>

namespace lapwing::gpu {

class Context;

/// Commands recorded once by a Recorder and submitted any number of times. Submitting allocates
/// nothing, so a drag frame is one `run()`. Not for use from several threads at once. The context
/// must outlive it; the destructor waits for the list's own last submission.
class CommandList {
 public:
  /// `name` appears in error messages. `timestamps` is how many `Recorder::timestamp` it can hold.
  CommandList(Context& context, std::string name, std::uint32_t timestamps = 0);
  ~CommandList();
  CommandList(const CommandList&) = delete;
  CommandList& operator=(const CommandList&) = delete;

  /// Submits and returns the timeline value to wait for. Lists run one after the other, and each
  /// sees what those submitted before it wrote. Throws GpuError if nothing was recorded. Waits
  /// first when the list's previous submission still runs.
  /// A swapchain's semaphores may be added as in `Context::submit`.
  std::uint64_t submit(std::span<const VkSemaphoreSubmitInfo> waits = {},
                       std::span<const VkSemaphoreSubmitInfo> signals = {});
  /// Waits for this list's last submission.
  void wait() const;
  void run() {
    submit();
    wait();
  }

  /// Device time between two timestamps of the last submission, which must be done. 0 on a device
  /// without timestamps.
  double milliseconds_between(std::uint32_t first, std::uint32_t second) const;

  Context& context() const { return context_; }
  const std::string& name() const { return name_; }
  VkCommandBuffer handle() const { return handle_; }
  bool recorded() const { return recorded_; }
  /// Whether the last submission is done, or there was none.
  bool done() const;

 private:
  friend class Recorder;

  struct Scope {
    VkPipelineStageFlags2 stages = 0;
    VkAccessFlags2 accesses = 0;
  };
  /// What commands recorded so far did to one buffer.
  struct History {
    VkBuffer buffer;
    Scope write;                        ///< the last write
    Scope visible;                      ///< reads that already wait for it
    VkPipelineStageFlags2 read_stages;  ///< reads since
  };

  void release() noexcept;
  std::uint64_t ticks_at(std::uint32_t query) const;
  void add_to_profile() const;

  Context& context_;
  std::string name_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer handle_ = VK_NULL_HANDLE;
  VkQueryPool queries_ = VK_NULL_HANDLE;
  std::uint32_t timestamp_capacity_;
  /// For Context::profile, behind the timestamps: one query before and after everything, then one
  /// before and after each of the first so many dispatches.
  std::uint32_t profile_capacity_ = 0;
  std::vector<std::string> profiled_kernels_;  ///< of the dispatches, in order
  mutable bool in_profile_ = true;             ///< whether the last submission is
  std::vector<History> histories_;             ///< kept, so that recording anew allocates nothing
  std::uint64_t last_submission_ = 0;
  bool recorded_ = false;
};

}  // namespace lapwing::gpu
