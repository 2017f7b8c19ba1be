#pragma once

#include <filesystem>

namespace lapwing {

/// Returns the real location of `path`, which need not exist: absolute, without "..", and with
/// every symbolic link followed, even to a missing target. Throws IoError if the links form a
/// cycle.
std::filesystem::path real_path(const std::filesystem::path& path);

/// Whether both paths lead to the same file, which need not exist.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Whether `path` is in `folder` or below; links are followed. Concurrent changes by other programs
/// are not detected.
bool is_inside(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace lapwing
