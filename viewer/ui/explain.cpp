#include "ui/explain.h"

#include <imgui.h>

namespace lapwing::viewer {
namespace {

// Width at which a tooltip wraps, in letters of the font.
constexpr float kTooltipLetters = 28.0F;

}  // namespace

void explain(std::string_view what, std::string_view more) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kTooltipLetters * ImGui::GetFontSize());
  ImGui::TextUnformatted(what.data(), what.data() + what.size());
  if (!more.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    ImGui::TextUnformatted(more.data(), more.data() + more.size());
    ImGui::PopStyleColor();
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void explain(Action action) {
  if (!ImGui::IsItemHovered()) return;
  const ControlLine control = control_of(action);
  explain(control.what, control.how.empty() ? std::string() : "key " + control.how);
}

}  // namespace lapwing::viewer
