#pragma once

#include <imgui.h>

namespace lapwing::viewer {

/// Flags of a window in the layout: it stays where it is and behind what opens over it.
inline constexpr ImGuiWindowFlags kFixed =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
/// Flags of a window that does not scroll.
inline constexpr ImGuiWindowFlags kWithoutScrolling =
    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;

}  // namespace lapwing::viewer
