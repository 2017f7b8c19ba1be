#include <imgui.h>
#include <string>

#include "navigation/keymap.h"
#include "ui/choose.h"
#include "ui/explain.h"
#include "ui/panels.h"

namespace lapwing::viewer {

void draw_preferences_panel(Preferences& preferences) {
  choose("theme", preferences.theme, {{"dark", Theme::dark}, {"light", Theme::light}});
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("mouse as in");
  for (const Keymap& keymap : keymaps()) {
    const std::string name(keymap.name);
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    stay_on_line(ImGui::CalcTextSize(name.c_str()).x + 1.5F * ImGui::GetFrameHeight(), right);
    if (ImGui::RadioButton(name.c_str(), preferences.mouse == name)) preferences.mouse = name;
  }
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("unit");
  for (const char* unit : {"", "mm", "cm", "m", "in"}) {
    ImGui::SameLine();
    const char* name = *unit == '\0' ? "none" : unit;
    if (ImGui::RadioButton(name, preferences.unit == unit)) preferences.unit = unit;
    explain("Written behind lengths; files hold numbers without a unit.");
  }
  ImGui::Checkbox("guide at the picture", &preferences.shows_guide);
  explain("What to do now, step by step.");
  ImGui::Checkbox("the desktop's file dialogs", &preferences.uses_system_dialogs);
  explain("Where it has any (zenity, kdialog); otherwise the viewer's own.");
}

}  // namespace lapwing::viewer
