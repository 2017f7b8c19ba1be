#pragma once

#include <string>

#include "editing/editor.h"
#include "ui/view_pen.h"

namespace lapwing::viewer {

/// Draws `gizmo` over the picture. Highlights `taken_part`, which is under the cursor or dragged.
/// Reuses the memory of `lines`.
void draw_gizmo(Pen& pen, const Gizmo& gizmo, GizmoPart taken_part, GizmoLines& lines);
/// Draws the gizmo of the current handle. Writes beside it how far the user has dragged.
void draw_gizmo(Pen& pen, const Editor& editor, GizmoLines& lines, std::string& readout);

/// Draws the mode, axes and pivot of the gizmo, and whether the handle sticks to the surface. These
/// are preferences of the view.
void draw_gizmo_panel(Editor& editor);

}  // namespace lapwing::viewer
