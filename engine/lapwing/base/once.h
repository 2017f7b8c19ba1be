#pragma once

#include <atomic>
#include <mutex>

namespace lapwing {

/// Makes something in the first call, whichever thread that is; others wait for it. A call that
/// throws, as a cancelled one does, has made nothing, and the next one tries again. (After a throw,
/// `std::call_once` waits forever under ThreadSanitizer, and with libstdc++ on some systems.)
class Once {
 public:
  /// Calls make() unless a call of it has returned. `make` must not come back here.
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
