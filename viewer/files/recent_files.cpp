#include "files/recent_files.h"

#include <algorithm>
#include <fcntl.h>
#include <fstream>
#include <string>
#include <sys/file.h>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/io/atomic_file.h"
#include "lapwing/io/file_bytes.h"
#include "state/user_folder.h"

namespace lapwing::viewer {
namespace {

namespace fs = std::filesystem;

// The list has a few kilobytes. A larger file is not read.
constexpr std::size_t kMostBytes = 1U << 20U;

// Reads the paths in `list` and skips lines that are not absolute paths.
std::vector<fs::path> read_list(const fs::path& list) {
  std::vector<fs::path> paths;
  std::error_code error;
  if (fs::file_size(list, error) > kMostBytes || error) return paths;
  std::ifstream file(list, std::ios::binary);
  for (std::string line; paths.size() < RecentFiles::kMost && std::getline(file, line);) {
    if (!line.starts_with('/') || line.find('\0') != std::string::npos) continue;
    if (std::ranges::find(paths, fs::path(line)) == paths.end()) paths.emplace_back(line);
  }
  return paths;
}

}  // namespace

fs::path recent_files_path() {
  return user_folder("XDG_STATE_HOME", ".local/state") / "recent-files";
}

RecentFiles::RecentFiles(fs::path kept_in) : kept_in_(std::move(kept_in)) {
  reload();
}

void RecentFiles::reload() {
  items_.clear();
  for (fs::path& path : read_list(kept_in_)) {
    std::error_code error;
    const bool is_there = fs::exists(path, error);
    items_.push_back({std::move(path), is_there});
  }
}

void RecentFiles::add(const fs::path& file) {
  const fs::path path = fs::absolute(file).lexically_normal();
  // Skip a path that contains a newline, because each line is one path.
  if (path.string().find('\n') != std::string::npos) return;
  change({path}, true);
}

void RecentFiles::clear() {
  change({}, false);
}

void RecentFiles::change(const std::vector<fs::path>& first, bool keeps_others) {
  if (kept_in_.empty()) return;
  std::error_code error;
  fs::create_directories(kept_in_.parent_path(), error);
  // Lock a separate file, because the list itself is replaced.
  const std::string lock_path = kept_in_.string() + ".lock";
  const FileDescriptor lock(open(lock_path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (lock.is_open()) flock(lock.get(), LOCK_EX);
  std::vector<fs::path> paths = first;
  if (keeps_others) {
    for (fs::path& other : read_list(kept_in_)) {
      if (std::ranges::find(paths, other) == paths.end()) paths.push_back(std::move(other));
    }
  }
  paths.resize(std::min(paths.size(), kMost));
  std::string text;
  for (const fs::path& path : paths) text += path.string() + '\n';
  try {
    replace_file(kept_in_, text);
  } catch (const IoError&) {
    // Do not report the error, because the user's action has succeeded.
  }
  reload();
}

}  // namespace lapwing::viewer
