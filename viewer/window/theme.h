#pragma once

namespace lapwing::viewer {

/// Fonts, sizes and colours of the panels on a desktop that enlarges by `scale`. The current ImGui
/// context's fonts are made anew.
void set_theme(double scale);

}  // namespace lapwing::viewer
