#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace lapwing::viewer {

/// The home folder of the person, from $HOME; empty where that is not said.
std::filesystem::path home_folder();

/// `path` with "~" at the beginning for the home folder, as in "~/models/hand.ply", where it lies
/// there; for display.
std::string with_tilde(const std::filesystem::path& path);

/// The absolute path that a person means by `typed`: "~" and "~/x" are in the home folder, what
/// does not begin with "/" is in `folder`, "." and ".." are resolved by name. Spaces around it do
/// not count. Nothing is looked up on the disk.
std::filesystem::path path_of(std::string_view typed, const std::filesystem::path& folder);

/// `typed`, continued as far as the names on the disk allow but one way: "mod" becomes "models/"
/// where that is the only name that begins so, "a" becomes "arm" for "arm-1.ply" and "arm-2.ply".
/// Case is corrected where no name has the case that was typed. `typed` itself where nothing
/// begins so, and where the folder cannot be read. Hidden names are left out unless their dot is
/// typed. Reads one folder.
std::string completed(std::string_view typed, const std::filesystem::path& folder);

}  // namespace lapwing::viewer
