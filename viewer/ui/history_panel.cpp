#include <array>
#include <cstdio>
#include <imgui.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

// Draws a button that goes one step through the history. Its tooltip names the step, if there is
// one.
bool draw_step_button(const char* label, Action action, const std::string* step) {
  const bool pressed = ImGui::Button(label);
  if (step == nullptr) {
    explain(action);
  } else if (ImGui::IsItemHovered()) {  // avoids allocating the words in every frame
    explain(label + (": " + *step), "Shortcut: " + control_of(action).how);
  }
  return pressed;
}

}  // namespace

std::optional<PathPurpose> draw_history_panel(Editor& editor, PanelDrafts& drafts) {
  const History& history = editor.session().history();
  const std::size_t done = history.done();
  if (draw_step_button("Undo", Action::undo, done > 0 ? &history.name(done - 1) : nullptr)) {
    editor.actions().undo();
  }
  ImGui::SameLine();
  if (draw_step_button("Redo", Action::redo, history.can_redo() ? &history.name(done) : nullptr)) {
    editor.actions().redo();
  }
  std::optional<PathPurpose> purpose;
  const float right = right_end();
  stay_on_line(button_width("Save recipe..."), right);
  if (ImGui::Button("Save recipe...")) purpose = PathPurpose::save_recipe;
  explain(Action::save_recipe);
  stay_on_line(button_width("Replay..."), right);
  if (ImGui::Button("Replay...")) purpose = PathPurpose::replay_recipe;
  explain(Action::replay_recipe);

  std::optional<std::size_t> chosen;
  ImGui::BeginChild("steps");
  if (ImGui::Selectable("Opened", history.done() == 0)) chosen = 0;
  for (std::size_t k = 0; k < history.size(); ++k) {
    const bool undone = k >= history.done();
    if (undone)
      ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    std::array<char, 128> label{};
    std::snprintf(label.data(), label.size(), "%zu  %s", k + 1, history.name(k).c_str());
    if (ImGui::Selectable(label.data(), k + 1 == history.done())) chosen = k + 1;
    if (undone) ImGui::PopStyleColor();
  }
  if (drafts.history_shown != history.done()) ImGui::SetScrollHereY(1.0F);
  drafts.history_shown = history.done();
  ImGui::EndChild();
  if (chosen) editor.actions().go_to(*chosen);
  return purpose;
}

}  // namespace lapwing::viewer
