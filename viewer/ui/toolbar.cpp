#include <imgui.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

using Role = Part::Role;

// Draws a button that makes the tools choose `part`, with its colour on the surface.
void draw_part(Editor& editor, const char* name, const Part& part, const ImVec4& color,
               Action action) {
  draw_swatch(color);
  const bool chosen = editor.tool().part().role == part.role && editor.tool().chooses_parts();
  if (toggle_button(name, chosen)) editor.tool().begin_choosing(part);
  explain(action);
}

}  // namespace

double draw_toolbar(Editor& editor, const PictureArea& area) {
  constexpr ImGuiWindowFlags kBar = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus |
                                    ImGuiWindowFlags_NoFocusOnAppearing;
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::SetNextWindowPos(to_imgui(area.corner));
  const float across = static_cast<float>(area.size.x());
  // The height follows from the rows, and is known after the layout.
  ImGui::SetNextWindowSizeConstraints({across, 0.0F}, {across, 1e6F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {style.WindowPadding.x, style.FramePadding.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  float height = 0.0F;
  if (ImGui::Begin("Tools", nullptr, kBar | ImGuiWindowFlags_AlwaysAutoResize)) {
    const float right = ImGui::GetWindowPos().x + across - style.WindowPadding.x;
    const float swatch = swatch_width();
    const auto& handles = editor.state().selection.handles;
    const std::size_t handle = editor.tool().part().role == Role::handle
                                   ? editor.tool().part().handle
                               : handles.empty() ? 0
                                                 : editor.tool().handle();
    draw_part(editor, "Region", {Role::roi}, kRoiColor, Action::choose_roi);
    stay_on_line(button_width("Handle") + swatch, right);
    draw_part(editor, "Handle", {Role::handle, handle}, kHandleColor, Action::choose_handle);
    stay_on_line(button_width("Fixed border") + swatch, right);
    draw_part(editor, "Fixed border", {Role::belt}, kBeltColor, Action::choose_belt);
    bool first = true;
    for (const ToolRow& row : tool_rows()) {
      const float gap = first ? 2.0F * style.ItemSpacing.x : 0.0F;
      stay_on_line(button_width(row.name) + gap, right);
      const bool is_at_start = ImGui::GetCursorPosX() <= style.WindowPadding.x;
      if (first && !is_at_start) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + gap);
      first = false;
      if (toggle_button(row.name, editor.tool().row() == &row)) editor.tool().take(row);
      explain(row.action);
    }
    height = ImGui::GetWindowHeight();
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
  return static_cast<double>(height);
}

}  // namespace lapwing::viewer
