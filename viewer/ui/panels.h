#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>

#include "lapwing/mesh/shapes.h"
#include "navigation/keymap.h"
#include "ui/document.h"
#include "window/app.h"

namespace lapwing::viewer {

// The panels. Each lays itself out with ImGui where the caller has begun a window, and changes only
// what it is given.

/// File, sizes, and what the mesh doctor found.
void draw_mesh_panel(const Document& document);

/// How the picture looks.
struct DisplayChoices {
  SurfaceStyle style;
  Background background = Background::gradient;
};
void draw_display_panel(DisplayChoices& choices, const Document& document);

/// What each part of a frame took.
void draw_timings_panel(const FrameTimings& timings);

/// Messages, the newest last.
void draw_log_panel(std::span<const std::string> messages);

/// The list of controls, in a window of its own; `open` turns false when it is closed.
void draw_controls_list(const Keymap& keymap, bool& open);

/// What a person chose to open.
using Choice = std::variant<std::filesystem::path, const NamedShape*>;
/// Meshes to begin with, in a window of its own: `samples`, generated ones, or a path that is typed
/// in and kept in `typed`.
std::optional<Choice> draw_start_panel(std::span<const std::filesystem::path> samples,
                                       std::string& typed);

/// A picture that a person wants to save.
struct PicturePlan {
  bool open = false;  ///< whether the panel is shown
  std::string path = "lapwing.png";
  int width = 0;  ///< in pixels, both at least 1
  int height = 0;
};
/// Asks for path and size, in a window of its own; true when the picture is to be saved.
bool draw_picture_panel(PicturePlan& plan);

/// Meshes and recipes worth opening, of those that tools/demo and tools/test fetched: looked for in
/// build/models and tools/recipes here, and beside the program's build folder.
std::vector<std::filesystem::path> find_samples();

}  // namespace lapwing::viewer
