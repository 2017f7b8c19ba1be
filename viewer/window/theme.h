#pragma once

#include <imgui.h>

#include "preferences/preferences.h"
#include "state/message.h"

namespace lapwing::viewer {

/// Fonts of the panels on a desktop that enlarges by `scale`: those of the current ImGui context
/// are made anew.
void set_fonts(double scale);
/// Colours and sizes of the panels. Text has a contrast of 4.5 : 1 or more to whatever panel,
/// field or button it stands on (WCAG 2.1, 1.4.3).
void set_theme(Theme theme, double scale);

/// The colour of text of that tone, in the theme that was set last.
const ImVec4& text_color(Tone tone);

}  // namespace lapwing::viewer
