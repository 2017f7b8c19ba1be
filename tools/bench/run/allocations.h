#pragma once

#include <cstdint>

namespace lapwing::bench {

/// How often this process has called operator new so far, on all threads. Memory that libraries
/// take by malloc is not in it.
std::uint64_t allocation_count();

}  // namespace lapwing::bench
