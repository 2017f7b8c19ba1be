#pragma once

#include <array>
#include <string>

#include "editing/editor.h"
#include "ui/view_pen.h"

namespace lapwing::viewer {

/// The colours of the x, y and z axes.
inline constexpr std::array kAxisColors{IM_COL32(235, 80, 80, 255), IM_COL32(120, 205, 80, 255),
                                        IM_COL32(90, 150, 250, 255)};

/// Draws `gizmo` over the 3D view. Highlights `taken_part`, the part under the cursor or the
/// dragged part. `lines` is a buffer that is reused in every frame.
void draw_gizmo(Pen& pen, const Gizmo& gizmo, GizmoPart taken_part, GizmoLines& lines);
/// Draws the gizmo of the current handle and, during a drag, the status line beside it.
void draw_gizmo(Pen& pen, const Editor& editor, GizmoLines& lines, std::string& readout);

/// Draws the mode, axes and pivot of the gizmo, and whether the handle sticks to the surface. These
/// are preferences of the view.
void draw_gizmo_panel(Editor& editor);

}  // namespace lapwing::viewer
