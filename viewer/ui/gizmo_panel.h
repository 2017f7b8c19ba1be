#pragma once

#include "editing/editor.h"

namespace lapwing::viewer {

/// Draws the mode, axes and pivot of the gizmo, and whether the handle sticks to the surface. These
/// are preferences of the view.
void draw_gizmo_panel(Editor& editor);

}  // namespace lapwing::viewer
