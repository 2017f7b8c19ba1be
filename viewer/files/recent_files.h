#pragma once

#include <filesystem>
#include <span>
#include <vector>

namespace lapwing::viewer {

/// Where the list is kept: lapwing/recent-files in $XDG_STATE_HOME, or in ~/.local/state.
std::filesystem::path recent_files_path();

/// Meshes and recipes that were opened, the newest first, kept in a file with one absolute path a
/// line, so that other viewers see them. What cannot be read or written there is no error: then
/// nothing is remembered.
class RecentFiles {
 public:
  static constexpr std::size_t kMost = 12;

  struct Item {
    std::filesystem::path path;
    bool is_there = true;  ///< when the list was read
  };

  /// `kept_in` need not be there; without a name nothing is remembered. Reads it.
  explicit RecentFiles(std::filesystem::path kept_in);

  std::span<const Item> items() const { return items_; }
  /// Reads the list anew: other viewers may have added to it.
  void reload();
  /// Puts `file` first. The list on the disk is read, changed and replaced under a lock, so that
  /// viewers that add at the same time lose nothing.
  void add(const std::filesystem::path& file);
  void clear();

 private:
  void change(const std::vector<std::filesystem::path>& first, bool keeps_others);

  std::filesystem::path kept_in_;
  std::vector<Item> items_;
};

}  // namespace lapwing::viewer
