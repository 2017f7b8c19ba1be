#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lapwing::viewer {

/// What a person is asked for a path for.
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

/// Files that go together in a dialog: "Meshes", by their extensions, lower case, with the dot.
/// Without extensions it is all files.
struct FileKind {
  std::string_view name;
  std::span<const std::string_view> extensions;

  /// Whether `file` is one of them, in either case of letters.
  bool holds(const std::filesystem::path& file) const;
};

/// How the path is asked for.
struct PathWords {
  enum class Wants { file, new_file, folder };

  std::string_view title;
  std::string_view note;
  std::string_view button;  ///< what it does with the path
  Wants wants = Wants::file;
  std::span<const FileKind> kinds;  ///< to choose from, the first at first; none for a folder
};
const PathWords& words_of(PathPurpose purpose);

/// A name that was given to a new file, with the extension of `suggested` where it has none that
/// is of the kinds of `purpose`: "hand" becomes "hand.ply".
std::filesystem::path with_extension(std::filesystem::path typed, PathPurpose purpose,
                                     const std::filesystem::path& suggested);

/// Why `path`, absolute, cannot be what `purpose` wants, as far as that shows without reading it,
/// and what to do; empty where nothing is wrong.
std::string trouble_with(const std::filesystem::path& path, PathPurpose purpose);

}  // namespace lapwing::viewer
