#include <imgui.h>

#include "ui/panels.h"

namespace lapwing::viewer {
namespace {

void draw_lines(const char* id, const std::vector<ControlLine>& lines) {
  if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg)) return;
  for (const ControlLine& line : lines) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(line.how.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(line.what.c_str());
  }
  ImGui::EndTable();
}

}  // namespace

void draw_controls_list(const Keymap& keymap, bool& open) {
  const ImVec2 center = ImGui::GetMainViewport()->GetCenter();
  ImGui::SetNextWindowPos(center, ImGuiCond_Always, {0.5F, 0.5F});
  const ImVec2 all = ImGui::GetMainViewport()->WorkSize;
  ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {0.95F * all.x, 0.95F * all.y});
  const bool shown = ImGui::Begin(
      "Controls", &open,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
  if (shown) {
    ImGui::TextDisabled("Mouse, as in %s", std::string(keymap.name).c_str());
    draw_lines("mouse", mouse_controls(keymap));
    ImGui::Spacing();
    ImGui::TextDisabled("Keys");
    draw_lines("keys", key_controls());
  }
  ImGui::End();
}

}  // namespace lapwing::viewer
