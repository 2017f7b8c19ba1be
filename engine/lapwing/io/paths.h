#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

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

/// Returns the regular file that `name` refers to. `name` comes from a mesh file or a material
/// library in `folder`. The result is the file `name` relative to `folder` if that exists.
/// Otherwise it is the file below `folder` whose relative path is the longest suffix of `name`,
/// such as "maps/skin.png" for "C:\proj\maps\skin.png". Returns nullopt if no suffix names a file.
///
/// The names may come from other operating systems. Backslashes therefore separate folders, too. If
/// no exact match exists, the function ignores case.
///
/// Mesh files are untrusted. The function ignores all of `name` up to the last "..", so `name`
/// cannot lead outside `folder`.
std::optional<std::filesystem::path> find_named_file(const std::filesystem::path& folder,
                                                     std::string_view name);

}  // namespace lapwing
