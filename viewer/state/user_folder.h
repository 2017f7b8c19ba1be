#pragma once

#include <filesystem>

namespace lapwing::viewer {

/// Returns the folder "lapwing" for one kind of the user's files, by the XDG base directory
/// specification. Its parent is the value of `variable`, such as XDG_CACHE_HOME, if that is an
/// absolute path, else `below_home`, such as ".cache", in the home directory. It may not exist yet.
std::filesystem::path user_folder(const char* variable, const char* below_home);

}  // namespace lapwing::viewer
