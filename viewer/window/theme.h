#pragma once

#include <imgui.h>

#include "preferences/preferences.h"
#include "state/message.h"

namespace lapwing::viewer {

/// Rebuilds the fonts of the current ImGui context for the desktop's scale factor `scale`.
void set_fonts(double scale);
/// Sets the colours and sizes of the panels. Text has a contrast of at least 4.5 : 1 to its
/// background (WCAG 2.1, 1.4.3).
void set_theme(Theme theme, double scale);

/// Returns the text colour for messages of this tone in the current theme.
const ImVec4& text_color(Tone tone);

}  // namespace lapwing::viewer
