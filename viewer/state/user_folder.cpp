#include "state/user_folder.h"

#include <cstdlib>

namespace lapwing::viewer {

namespace fs = std::filesystem;

fs::path user_folder(const char* variable, const char* below_home) {
  const char* folder = std::getenv(variable);
  if (folder != nullptr && *folder == '/') return fs::path(folder) / "lapwing";
  const char* home = std::getenv("HOME");
  const fs::path base = home != nullptr ? fs::path(home) : fs::temp_directory_path();
  return base / below_home / "lapwing";
}

}  // namespace lapwing::viewer
