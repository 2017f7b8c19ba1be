#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lapwing::viewer {

enum class Theme { dark, light };

/// What a person chooses once, for every mesh.
struct Preferences {
  Theme theme = Theme::dark;
  std::string mouse = "Blender";  ///< name of a keymap
  std::string unit;               ///< written behind lengths, as in "mm"; empty: none
  bool shows_guide = true;        ///< at the picture: what to do now
  bool settles_while_dragging = true;
  bool uses_system_dialogs = true;  ///< the desktop's, for files, where there are any
  double sidebar_letters = 24.0;    ///< its width, in letters of the font
  int window_width = 1280;          ///< in points (tools/projection.h)
  int window_height = 800;
  std::string tool = "Disk";  ///< the one that a new mesh begins with
  double brush_radius_pt = 20.0;
  bool paints_through = false;

  bool operator==(const Preferences&) const = default;
};

/// $XDG_CONFIG_HOME/lapwing/viewer.json, or that of ~/.config.
std::filesystem::path preferences_file();

/// What was read, and what of it could not be: one sentence each, which names the file.
struct ReadPreferences {
  Preferences preferences;
  std::vector<std::string> troubles;
};
/// Defaults where there is no file. Never throws for what a file holds.
ReadPreferences read_preferences(const std::filesystem::path& file);

/// Makes the folder where there is none and replaces the file in one step. Keys that this version
/// does not know stay in it. Throws IoError.
void write_preferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace lapwing::viewer
