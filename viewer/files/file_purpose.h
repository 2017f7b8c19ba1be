#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lapwing::viewer {

/// The purpose of a path that the user is asked for.
enum class PathPurpose {
  open,
  save_mesh,
  save_repaired,
  save_recipe,
  replay_recipe,
  open_source,
  carry_file,
  save_picture,
  save_turntable,
  parts_folder,
  use_part,
  add_part,
};

/// A filter of a file dialog, such as "Meshes": extensions in lower case, with the dot. Without
/// extensions it matches all files.
struct FileKind {
  std::string_view name;
  std::span<const std::string_view> extensions;

  /// Whether the filter matches `file`, in upper or lower case.
  bool holds(const std::filesystem::path& file) const;
};

/// The texts and filters of a file dialog.
struct PathWords {
  enum class Wants { file, new_file, folder };

  std::string_view title;
  std::string_view note;
  std::string_view button;  ///< label of the button that accepts the path
  Wants wants = Wants::file;
  std::span<const FileKind> kinds;  ///< filters, the default one first; none for a folder
};
const PathWords& words_of(PathPurpose purpose);

/// Returns the name typed for a new file, with the extension of `suggested` if it has none: "hand"
/// becomes "hand.ply". An extension that looks like another format stays.
std::filesystem::path with_extension(std::filesystem::path typed, PathPurpose purpose,
                                     const std::filesystem::path& suggested);

/// Returns why the absolute `path` does not suit `purpose`, and what to do; empty if nothing is
/// wrong. Does not read the file.
std::string trouble_with(const std::filesystem::path& path, PathPurpose purpose);

}  // namespace lapwing::viewer
