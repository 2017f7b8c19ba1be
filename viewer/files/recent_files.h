#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace lapwing::viewer {

/// Returns the path of the list: lapwing/recent-files in $XDG_STATE_HOME, by default in
/// ~/.local/state.
std::filesystem::path recent_files_path();

/// Meshes and recipes that were opened, the newest first. All viewers share the file that holds
/// them, one absolute path per line. If it cannot be read or written, nothing is remembered; that
/// is no error.
class RecentFiles {
 public:
  static constexpr std::size_t kMost = 12;

  struct Item {
    std::filesystem::path path;
    bool is_there = true;  ///< existed when the list was read
  };

  /// Reads `kept_in`, which need not exist. If the path is empty, nothing is remembered.
  explicit RecentFiles(std::filesystem::path kept_in);

  std::span<const Item> items() const { return items_; }
  /// Reads the list again, because other viewers may have added to it.
  void reload();
  /// Puts `file` first. Reads, changes and replaces the list under a lock, so that viewers that add
  /// files at the same time lose none.
  void add(const std::filesystem::path& file);
  void clear();

 private:
  void change(const std::vector<std::filesystem::path>& first, bool keeps_others);

  std::filesystem::path kept_in_;
  std::vector<Item> items_;
};

}  // namespace lapwing::viewer
