#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lapwing::viewer {

/// The purpose for which the viewer asks the user for a path.
enum class PathPurpose {
  open,
  save_mesh,
  save_repaired,
  save_recipe,
  replay_recipe,
  open_source,
  open_scan,
  load_landmarks,
  load_scan_landmarks,
  save_landmarks,
  carry_file,
  save_picture,
  save_turntable,
  parts_folder,
  use_part,
  add_part,
};

/// A filter of a file dialog, such as "Meshes".
struct FileKind {
  std::string_view name;
  /// Lower-case extensions with the dot. If empty, the filter matches all files.
  std::span<const std::string_view> extensions;

  /// Returns whether the filter matches `file`. Not case-sensitive.
  bool holds(const std::filesystem::path& file) const;
};

/// The texts and filters of a file dialog.
struct PathWords {
  enum class Wants { file, new_file, folder };

  std::string_view title;
  std::string_view note;
  std::string_view button;  ///< label of the button that accepts the path
  Wants wants = Wants::file;
  std::span<const FileKind> kinds;  ///< filters, starting with the default; empty for a folder
};
const PathWords& words_of(PathPurpose purpose);

/// Returns `typed`, the name of a new file. If it has no extension, appends that of `suggested`:
/// "hand" becomes "hand.ply". Does not change an extension that may be another format.
std::filesystem::path with_extension(std::filesystem::path typed, PathPurpose purpose,
                                     const std::filesystem::path& suggested);

/// Returns a message with the reason why the absolute `path` cannot be used for `purpose`, and the
/// next step. Empty if the path can be used. Does not read the file.
std::string trouble_with(const std::filesystem::path& path, PathPurpose purpose);

}  // namespace lapwing::viewer
