#pragma once

#include <cstddef>
#include <functional>

namespace lapwing {

/// Returns the number of threads of `parallel_for`: the processors available to this process, or
/// the environment variable LAPWING_THREADS, from 1 to 256. Read once.
unsigned thread_count();

/// Implementation of `parallel_for`; call that instead.
void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Splits [0, count) into contiguous ranges of at least `grain` items and calls `body(begin, end)`
/// once per range, on up to `thread_count()` threads. The ranges are disjoint and cover everything.
/// If a body writes only the results of its own items, the bits do not depend on the number of
/// threads. Rethrows the first exception of a body; the other threads stop at their next
/// `check_cancelled`. Throws Cancelled between two ranges. Allocates nothing.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  // By reference, because a std::function would allocate a copy of the body.
  parallel_ranges(count, grain, std::cref(body));
}

/// Implementation of `parallel_invoke`; call that instead.
void parallel_pair(const std::function<void()>& here, const std::function<void()>& aside);

/// Calls `here` on this thread and `aside` on another thread at the same time, or afterwards on
/// this thread if none is free. When both have ended, rethrows the exception of `here`, or else
/// that of `aside`. If `here` throws, `aside` stops at its next `check_cancelled`.
template <typename Here, typename Aside>
void parallel_invoke(const Here& here, const Aside& aside) {
  parallel_pair(std::cref(here), std::cref(aside));
}

}  // namespace lapwing
