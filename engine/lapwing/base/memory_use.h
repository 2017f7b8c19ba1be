#pragma once

#include <cstddef>
#include <filesystem>

namespace lapwing {

/// Returns the peak resident memory of this process in bytes, or 0 if unknown.
std::size_t peak_memory_bytes();

/// Returns the number of bytes that this process can still allocate, or 0 if unknown. Considers the
/// machine, the control groups (version 1 and 2), and the limits of the process (`ulimit -v`,
/// `ulimit -d`). The file cache of a control group counts as free, because the system can release
/// it. Takes about 0.1 ms.
std::size_t available_memory_bytes();

/// Reads the available memory from files below `root`, which replaces "/". Considers only the
/// machine and the control groups. For tests.
std::size_t available_memory_bytes(const std::filesystem::path& root);

}  // namespace lapwing
