#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace lapwing::viewer {

/// Returns the path of the list: lapwing/recent-files in $XDG_STATE_HOME, by default in
/// ~/.local/state.
std::filesystem::path recent_files_path();

/// The list of recently opened meshes and recipes, the newest first. All viewers share the file
/// that stores it, with one absolute path per line. If the file cannot be read or written, the list
/// is not stored; this is not an error.
class RecentFiles {
 public:
  static constexpr std::size_t kMost = 12;

  struct Item {
    std::filesystem::path path;
    bool is_there = true;  ///< whether the file existed when the list was read
  };

  /// Reads the list from `kept_in` if this file exists. If `kept_in` is empty, no list is stored.
  explicit RecentFiles(std::filesystem::path kept_in);

  std::span<const Item> items() const { return items_; }
  /// Reads the list again, because other viewers may have added to it.
  void reload();
  /// Moves or adds `file` to the front of the list. Locks the list while it is changed, so that
  /// several viewers may add files at the same time.
  void add(const std::filesystem::path& file);
  void clear();

 private:
  void change(const std::vector<std::filesystem::path>& first, bool keeps_others);

  std::filesystem::path kept_in_;
  std::vector<Item> items_;
};

}  // namespace lapwing::viewer
