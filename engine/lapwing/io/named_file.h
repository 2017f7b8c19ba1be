#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace lapwing {

/// The regular file that `name`, read from a mesh file or material library in `folder`, means:
/// `name` relative to `folder`, else the file of its last part in `folder` itself. Backslashes
/// separate folders, and where nothing is spelled so, other cases of letters will do, since such
/// names come from other systems. Nothing if there is none.
///
/// Such a file may come from anyone, so it never names what lies elsewhere: of a name that is
/// absolute, has a drive or a "..", only the last part counts.
std::optional<std::filesystem::path> find_named_file(const std::filesystem::path& folder,
                                                     std::string_view name);

}  // namespace lapwing
