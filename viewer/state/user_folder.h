#pragma once

#include <filesystem>

namespace lapwing::viewer {

/// The folder "lapwing" of the person's files of one kind, by the XDG base directory specification:
/// in that of the environment's `variable` where it is an absolute path, as in XDG_CACHE_HOME, else
/// in `below_home`, as in ".cache". Need not be there.
std::filesystem::path user_folder(const char* variable, const char* below_home);

}  // namespace lapwing::viewer
