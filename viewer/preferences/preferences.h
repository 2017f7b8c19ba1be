#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lapwing::viewer {

enum class Theme { dark, light };

/// The user's preferences, the same for every mesh.
struct Preferences {
  Theme theme = Theme::dark;
  std::string mouse = "Blender";  ///< name of a keymap
  std::string unit;               ///< written behind lengths, as in "mm"; empty: none
  bool shows_guide = true;        ///< show over the picture what to do next
  bool settles_while_dragging = true;
  bool uses_system_dialogs = true;  ///< use the desktop's file dialogs if there are any
  double sidebar_letters = 24.0;    ///< sidebar width, in letters of the font
  int window_width = 1280;          ///< in points (tools/projection.h)
  int window_height = 800;
  std::string tool = "Grab";  ///< tool that a new mesh begins with
  double brush_radius_pt = 20.0;
  double grab_radius_pt = 40.0;
  bool paints_through = false;

  bool operator==(const Preferences&) const = default;
};

/// Returns lapwing/viewer.json in $XDG_CONFIG_HOME, by default in ~/.config.
std::filesystem::path preferences_file();

/// The preferences in a file, and a sentence with the file's name for each that could not be read.
struct ReadPreferences {
  Preferences preferences;
  std::vector<std::string> troubles;
};
/// Returns the defaults if there is no file. Never throws because of the file's content.
ReadPreferences read_preferences(const std::filesystem::path& file);

/// Replaces the file atomically and creates its folder if needed. Keeps keys that this version does
/// not know. Throws IoError.
void write_preferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace lapwing::viewer
