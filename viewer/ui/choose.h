#pragma once

#include <imgui.h>
#include <initializer_list>
#include <utility>

namespace lapwing::viewer {

/// Draws choices on one line after `label`. Sets `value` to the one that is clicked, and returns
/// whether one was.
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

/// Draws a button that is highlighted while `on`. Returns whether it was pressed.
inline bool toggle_button(const char* label, bool on) {
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
  }
  const bool pressed = ImGui::Button(label);
  if (on) ImGui::PopStyleColor();
  return pressed;
}

/// Stays on the line if an item of `width` still fits there, up to `right` on the screen.
inline void stay_on_line(float width, float right) {
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  if (ImGui::GetItemRectMax().x + spacing + width <= right) ImGui::SameLine();
}

}  // namespace lapwing::viewer
