#pragma once

#include <cstddef>
#include <filesystem>

namespace lapwing {

/// Returns the largest resident size of this process so far in bytes, or 0 if unknown.
std::size_t peak_memory_bytes();

/// Returns the bytes that this process can still allocate, or 0 if unknown. Considers the memory of
/// the machine, the control groups around the process (version 1 and 2), and its own limits
/// (`ulimit -v`, `ulimit -d`). The file cache of a control group counts as free, since the system
/// drops it first. Reads some files: about 0.1 ms.
std::size_t available_memory_bytes();

/// The same from files under `root`, laid out as under "/" on Linux. Considers only the machine and
/// the control groups.
std::size_t available_memory_bytes(const std::filesystem::path& root);

}  // namespace lapwing
