#pragma once

#include <cstddef>
#include <functional>

namespace lapwing {

/// Number of threads `parallel_for` uses: the processors this process may run on, or what the
/// environment's LAPWING_THREADS says, from 1 to 256. Read once.
unsigned thread_count();

/// What `parallel_for` does with a body of known type; callers use that.
void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Splits [0, count) into contiguous ranges of at least `grain` items and calls
/// `body(begin, end)` once per range, on up to `thread_count()` threads. Ranges are disjoint and
/// cover everything; a body that only writes what belongs to its own items gives the same bits for
/// every number of threads. The first exception thrown by a body is rethrown here; the others are
/// told to stop at their next `check_cancelled`. Throws Cancelled between two ranges. Allocates
/// nothing.
template <typename Body>
void parallel_for(std::size_t count, std::size_t grain, const Body& body) {
  // By reference: a std::function of the body itself would take memory for it.
  parallel_ranges(count, grain, std::cref(body));
}

/// What `parallel_invoke` does with bodies of known types; callers use that.
void parallel_pair(const std::function<void()>& here, const std::function<void()>& aside);

/// Calls `here` on this thread and `aside` on another one meanwhile, or afterwards here where none
/// is free. Rethrows what `here` throws, else what `aside` does, when both have ended; `aside` is
/// told to stop at its next `check_cancelled` when `here` has thrown.
template <typename Here, typename Aside>
void parallel_invoke(const Here& here, const Aside& aside) {
  parallel_pair(std::cref(here), std::cref(aside));
}

}  // namespace lapwing
