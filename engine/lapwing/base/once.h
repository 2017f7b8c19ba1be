#pragma once

#include <atomic>
#include <mutex>

namespace lapwing {

/// Runs an initialization in the first call; calls of other threads wait for it. If it throws, for
/// instance Cancelled, the next call tries again. (After an exception, `std::call_once` waits
/// forever under ThreadSanitizer, and with libstdc++ on some systems.)
class Once {
 public:
  /// Calls make() unless an earlier call has returned. `make` must not call this object.
  template <typename Make>
  void operator()(const Make& make) {
    if (made_.load(std::memory_order_acquire)) return;
    const std::scoped_lock lock(mutex_);
    if (made_.load(std::memory_order_relaxed)) return;
    make();
    made_.store(true, std::memory_order_release);
  }

 private:
  std::mutex mutex_;
  std::atomic<bool> made_ = false;
};

}  // namespace lapwing
