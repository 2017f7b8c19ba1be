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

}  // namespace lapwing::viewer
