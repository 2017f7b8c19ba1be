// The dialogs about files that do not ask for a path.

#include <imgui.h>

#include "files/path_text.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
std::optional<bool> draw_overwrite_panel(const std::filesystem::path& file) {
  std::optional<bool> choice;
  center_next_window();
  if (ImGui::Begin("Replace file?", nullptr, kDialog)) {
    ImGui::Text("%s already exists.", file.filename().c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", file.c_str());
    ImGui::TextDisabled("Enter replaces it, Escape goes back.");
    if (ImGui::Button("Replace") || is_pressed(ImGuiKey_Enter)) choice = true;
    ImGui::SameLine();
    if (ImGui::Button("Back")) choice = false;
  }
  ImGui::End();
  return choice;
}

std::optional<UnsavedChoice> draw_unsaved_panel(const std::string& name) {
  std::optional<UnsavedChoice> choice;
  center_next_window();
  if (ImGui::Begin("Save changes?", nullptr, kDialog)) {
    ImGui::Text("%s has unsaved changes.", name.c_str());
    ImGui::TextDisabled("Enter saves, Delete discards, Escape cancels.");
    if (ImGui::Button("Save") || is_pressed(ImGuiKey_Enter)) choice = UnsavedChoice::save;
    ImGui::SameLine();
    if (ImGui::Button("Discard") || is_pressed(ImGuiKey_Delete)) choice = UnsavedChoice::discard;
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) choice = UnsavedChoice::cancel;
  }
  ImGui::End();
  return choice;
}

std::optional<InterruptedChoice> draw_interrupted_panel(std::span<const InterruptedEdit> edits) {
  using What = InterruptedChoice::What;
  std::optional<InterruptedChoice> choice;
  center_next_window();
  if (ImGui::Begin("Interrupted edits", nullptr, kDialog)) {
    ImGui::TextDisabled("These edits were not closed properly. \"Restore\" runs the steps again.");
    ImGui::TextDisabled("Enter restores the latest edit.");
    for (std::size_t e = 0; e < edits.size(); ++e) {
      ImGui::PushID(static_cast<int>(e));
      const bool first = e == 0 && is_pressed(ImGuiKey_Enter);
      if (ImGui::Button("Restore") || first) choice = {e, What::restore};
      ImGui::SameLine();
      if (ImGui::Button("Discard")) choice = {e, What::discard};
      ImGui::SameLine();
      const std::size_t count = edits[e].step_count();
      const std::string steps = count == 0   ? "selection only"
                                : count == 1 ? "1 step"
                                             : std::to_string(count) + " steps";
      ImGui::Text("%s, %s, %s", edits[e].opened.filename().c_str(), steps.c_str(),
                  date_in_words(edits[e].last_step).c_str());
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", edits[e].opened.c_str());
      ImGui::PopID();
    }
    if (ImGui::Button("Later")) choice = {0, What::later};
  }
  ImGui::End();
  return choice;
}

}  // namespace lapwing::viewer
