#pragma once

#include <filesystem>

namespace lapwing {

/// Where a file that is opened or written as `path` lies, whether it is there or not: absolute,
/// without "..", and with every symbolic link followed, also one whose target is not there. Throws
/// IoError where the links go round in a circle.
std::filesystem::path real_path(const std::filesystem::path& path);

/// Whether both are one file, whatever the paths are written like, whether it is there or not.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Whether `path` lies in `folder` or below; links are followed. What somebody else changes in
/// between is not seen.
bool is_inside(const std::filesystem::path& path, const std::filesystem::path& folder);

}  // namespace lapwing
