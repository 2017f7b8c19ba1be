#pragma once

#include <cstddef>
#include <filesystem>

namespace lapwing {

/// Largest resident size of this process so far, in bytes; 0 where the system does not tell.
std::size_t peak_memory_bytes();

/// What this process may still take before the machine, a control group that it is in (of either
/// version, or one around that), or its own limit (`ulimit -v`, `ulimit -d`) refuses or ends it; 0
/// where the system does not tell. Files in a group's cache count as free, since the system drops
/// them first. Reads some files: about 0.1 ms.
std::size_t available_memory_bytes();

/// What files under `root`, laid out like those of a Linux system under "/", say of the machine and
/// of control groups.
std::size_t available_memory_bytes(const std::filesystem::path& root);

}  // namespace lapwing
