#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace lapwing {

/// Returns the regular file that `name`, read from a mesh file or material library in `folder`,
/// refers to: `name` relative to `folder`, else its last part in `folder` itself. Nullopt if there
/// is none. Such names come from other systems, so backslashes separate folders, and upper and
/// lower case may differ if there is no exact match.
///
/// Mesh files are untrusted, so a name never leads to other folders. If it is absolute or has a
/// drive or "..", only its last part is used.
std::optional<std::filesystem::path> find_named_file(const std::filesystem::path& folder,
                                                     std::string_view name);

}  // namespace lapwing
