#pragma once

#include <cstddef>
#include <functional>

namespace lapwing {

/// Number of threads `parallel_for` uses: the processors this process may run on.
unsigned thread_count();

/// Splits [0, count) into contiguous ranges of at least `grain` items and calls
/// `body(begin, end)` once per range, on up to `thread_count()` threads. Ranges are disjoint and
/// cover everything; a body that only writes what belongs to its own items gives the same bits for
/// every number of threads. The first exception thrown by a body is rethrown here.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace lapwing
