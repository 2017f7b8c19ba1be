#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lapwing::viewer {

/// Returns the user's home folder from $HOME; empty if that is not an absolute path.
std::filesystem::path home_folder();

/// Returns `path` for display. If it is in the home folder it starts with "~", as in
/// "~/models/hand.ply".
std::string with_tilde(const std::filesystem::path& path);

/// Returns the absolute path that the user means by `typed`. "~" and "~/x" are in the home folder,
/// a relative path is in `folder`, "." and ".." are resolved by name. Ignores spaces around it.
/// Does not access the disk.
std::filesystem::path path_of(std::string_view typed, const std::filesystem::path& folder);

/// Returns `typed`, continued as far as the names on the disk agree. "mod" becomes "models/" if no
/// other name starts so, "a" becomes "arm-" for "arm-1.ply" and "arm-2.ply". Corrects the case if
/// no name matches as typed. Returns `typed` unchanged if nothing starts so or the folder cannot be
/// read. Skips hidden names unless their dot is typed. Reads one folder.
std::string completed(std::string_view typed, const std::filesystem::path& folder);

}  // namespace lapwing::viewer
