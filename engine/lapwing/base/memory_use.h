#pragma once

#include <cstddef>

namespace lapwing {

/// Largest resident size of this process so far, in bytes; 0 where the system does not tell.
std::size_t peak_memory_bytes();

}  // namespace lapwing
