#pragma once

#include <cstdint>

namespace lapwing::bench {

/// Returns how often this process has called operator new so far, on all threads. Does not count
/// memory that libraries allocate with malloc.
std::uint64_t allocation_count();

}  // namespace lapwing::bench
