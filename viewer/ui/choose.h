#pragma once

#include <imgui.h>
#include <initializer_list>
#include <utility>

namespace lapwing::viewer {

/// One of several on a line behind `label`; `value` becomes the one that is clicked. Whether one
/// was.
template <typename Value>
bool choose(const char* label, Value& value,
            std::initializer_list<std::pair<const char*, Value>> choices) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", label);
  ImGui::PushID(label);
  bool clicked = false;
  for (const auto& [name, choice] : choices) {
    ImGui::SameLine();
    if (!ImGui::RadioButton(name, value == choice)) continue;
    value = choice;
    clicked = true;
  }
  ImGui::PopID();
  return clicked;
}

/// A button that stays lit while it is `on`; whether it was pressed.
inline bool toggle_button(const char* label, bool on) {
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
  }
  const bool pressed = ImGui::Button(label);
  if (on) ImGui::PopStyleColor();
  return pressed;
}

/// Begins no new line if an item `width` wide still fits on this one, up to `right` on the screen.
inline void stay_on_line(float width, float right) {
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  if (ImGui::GetItemRectMax().x + spacing + width <= right) ImGui::SameLine();
}

}  // namespace lapwing::viewer
