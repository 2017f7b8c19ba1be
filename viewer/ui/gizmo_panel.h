#pragma once

#include "editing/editor.h"

namespace lapwing::viewer {

/// What the gizmo shows, along what its axes go, what the handle turns about, and whether it sticks
/// to the surface: preferences of the view.
void draw_gizmo_panel(Editor& editor);

}  // namespace lapwing::viewer
