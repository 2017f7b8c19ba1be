#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

namespace lapwing {

/// Returns the number of threads of `parallel_for`: the value of the environment variable
/// LAPWING_THREADS, from 1 to 256, or the number of processors available to this process.
/// Determined once.
unsigned thread_count();

/// Implementation of `parallel_for`; call that instead.
void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Divides [0, count) into disjoint contiguous ranges of at least `grain` items and calls
/// `body(begin, end)` once per range, on up to `thread_count()` threads. If each call writes only
/// the results of its items, the result is bitwise independent of the number of threads. Rethrows
/// the first exception of a body; the other threads stop at their next `check_cancelled`. May throw
/// Cancelled between two ranges. Does not allocate.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  // Pass by reference, because a std::function would allocate a copy of the body.
  parallel_ranges(count, grain, std::cref(body));
}

/// Implementation of `parallel_invoke`; call that instead.
void parallel_pair(const std::function<void()>& here, const std::function<void()>& aside);

/// Calls `here` on this thread and `aside` on another at the same time, or afterwards on this
/// thread if no other is free. When both have ended, rethrows the exception of `here` or, if there
/// is none, of `aside`. If `here` throws, `aside` stops at its next `check_cancelled`.
template <typename Here, typename Aside>
void parallel_invoke(const Here& here, const Aside& aside) {
  parallel_pair(std::cref(here), std::cref(aside));
}

/// Runs an initialization in the first call; calls on other threads wait for it. If the
/// initialization throws, for example Cancelled, the next call repeats it. (After an exception,
/// `std::call_once` can block forever under ThreadSanitizer and with libstdc++.)
class Once {
 public:
  /// Calls make() unless an earlier call has succeeded. `make` must not call this object.
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
