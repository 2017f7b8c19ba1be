#pragma once

#include <imgui.h>

namespace lapwing::viewer {

// The colours of the parts of an edit on the surface (shaders/surface.glsl), for swatches beside
// their names.
inline const ImVec4 kRoiColor{0.55F, 0.65F, 0.80F, 1.0F};
inline const ImVec4 kHandleColor{0.95F, 0.80F, 0.25F, 1.0F};
inline const ImVec4 kBeltColor{0.85F, 0.30F, 0.25F, 1.0F};

/// Draws a square of that colour before an item with a frame, on the same line.
inline void draw_swatch(const ImVec4& color) {
  const float side = 0.7F * ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = at.y + 0.5F * (ImGui::GetFrameHeight() - side);
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side},
                                            ImGui::GetColorU32(color),
                                            0.13F * ImGui::GetFontSize());
  ImGui::Dummy({side, ImGui::GetFrameHeight()});
  ImGui::SameLine(0.0F, 0.25F * ImGui::GetFontSize());
}
inline float swatch_width() {
  return 0.95F * ImGui::GetFontSize();
}

}  // namespace lapwing::viewer
