#pragma once

#include <cstddef>

namespace lapwing {

/// Largest resident size of this process so far, in bytes; 0 where the system does not tell.
std::size_t peak_memory_bytes();

/// What this process may still take without the machine, or the group of processes that it is
/// limited with, running out; 0 where the system does not tell.
std::size_t available_memory_bytes();

}  // namespace lapwing
