#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <string_view>
#include <system_error>
#include <utility>

#include "lapwing/base/cancellation.h"

namespace lapwing {

/// A result computed on a background thread. Only one thread may call an object at a time. The
/// destructor tells the computation to stop and waits until it has ended. A task that uses other
/// members of its owner must therefore be the owner's last member.
template <typename T>
class BackgroundTask {
 public:
  BackgroundTask() = default;
  ~BackgroundTask() { stopped_ = true; }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Starts `make`, in which check_cancelled throws after the destructor has begun. Only the first
  /// call has an effect.
  template <typename Make>
  void begin(Make make) {
    if (std::exchange(has_begun_, true)) return;
    auto run = [this, make = std::move(make)] {
      const ProgressScope scope([this](std::string_view, double) { return !stopped_; });
      return make();
    };
    try {
      made_ = std::async(std::launch::async, run);
    } catch (const std::system_error&) {
      // If no thread can be started, `take` computes the result.
      made_ = std::async(std::launch::deferred, run);
    }
  }
  /// True from `begin` until the result is taken, even if the computation has ended.
  bool is_pending() const { return made_.valid(); }
  /// Returns true if `take` would return without waiting.
  bool is_made() const {
    return is_pending() && made_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
  }
  /// Waits for the result and rethrows the computation's exception. Call once, after `begin`.
  /// Throws Cancelled.
  T take() {
    while (made_.wait_for(kCheckInterval) == std::future_status::timeout) check_cancelled();
    return made_.get();
  }

 private:
  bool has_begun_ = false;
  std::atomic<bool> stopped_ = false;
  std::future<T> made_;  // last member, because it uses the others
};

}  // namespace lapwing
