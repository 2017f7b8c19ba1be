#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lapwing::viewer {

enum class Theme { dark, light };

/// The user's preferences. They apply to all meshes.
struct Preferences {
  Theme theme = Theme::dark;
  std::string mouse = "Blender";  ///< name of a keymap
  std::string unit;               ///< unit of lengths in panels, such as "mm"; may be empty
  bool shows_guide = true;        ///< show a guide with the next step in the view
  bool settles_while_dragging = true;
  bool uses_system_dialogs = true;  ///< use the desktop's file dialogs if there are any
  double sidebar_letters = 24.0;    ///< width of the sidebar, in letters of the font
  int window_width = 1280;          ///< in points (tools/projection.h)
  int window_height = 800;
  std::string tool = "Grab";  ///< tool that is active for a new mesh
  double brush_radius_pt = 20.0;
  double grab_radius_pt = 40.0;

  bool operator==(const Preferences&) const = default;
};

/// Returns the path lapwing/viewer.json in $XDG_CONFIG_HOME, by default in ~/.config.
std::filesystem::path preferences_file();

/// The preferences in a file, and a message for each invalid entry.
struct ReadPreferences {
  Preferences preferences;
  std::vector<std::string> troubles;
};
/// Reads preferences. Returns the defaults if the file does not exist. Does not throw if the file
/// is invalid.
ReadPreferences read_preferences(const std::filesystem::path& file);

/// Replaces the file atomically, and creates its folder if necessary. Preserves keys of the file
/// that this version does not know. Throws IoError.
void write_preferences(const Preferences& preferences, const std::filesystem::path& file);

}  // namespace lapwing::viewer
