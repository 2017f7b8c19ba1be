#pragma once

#include <filesystem>

namespace lapwing::viewer {

/// Returns a folder for the user's files, according to the XDG base directory specification. If the
/// environment variable `variable`, such as XDG_CACHE_HOME, contains an absolute path, this is the
/// folder "lapwing" in it; otherwise "lapwing" in the folder `below_home`, such as ".cache", of the
/// home directory. The folder may not exist.
std::filesystem::path user_folder(const char* variable, const char* below_home);

}  // namespace lapwing::viewer
