#include <imgui.h>
#include <utility>

#include "ui/choose.h"
#include "ui/panels.h"

namespace lapwing::viewer {
namespace {

using Role = Part::Role;

const ImVec4 kRoiColor{0.55F, 0.65F, 0.80F, 1.0F};
const ImVec4 kHandleColor{0.95F, 0.80F, 0.25F, 1.0F};
const ImVec4 kBeltColor{0.85F, 0.30F, 0.25F, 1.0F};

// A row that chooses `part`, in the colour that it has on the surface.
void draw_part(Editor& editor, const char* name, const Part& part, const ImVec4& color) {
  ImGui::PushID(name);
  ImGui::ColorButton("##color", color,
                     ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                     {ImGui::GetFontSize(), ImGui::GetFontSize()});
  ImGui::SameLine();
  if (ImGui::RadioButton(name, editor.part() == part)) editor.choose(part);
  const std::size_t count = editor.count(part);
  if (count > 0) {
    ImGui::SameLine();
    ImGui::TextDisabled("%zu", count);
  }
  ImGui::PopID();
}

std::string name_of_handle(const AppState& state, std::size_t h) {
  const ChosenHandle& handle = state.selection.handles[h];
  if (!is_pin(handle)) return "handle " + std::to_string(h + 1);
  return "pin " + std::to_string(h + 1) + ", vertex " + std::to_string(handle.vertices.front());
}

void draw_parts(Editor& editor) {
  draw_part(editor, "ROI", {Role::roi}, kRoiColor);
  const std::size_t handles = editor.state().selection.handles.size();
  // Many of them scroll, so that what follows stays where it is.
  constexpr std::size_t kRowsShown = 6;
  const bool scrolls = handles > kRowsShown;
  if (scrolls) {
    ImGui::BeginChild("handles", {0.0F, kRowsShown * ImGui::GetFrameHeightWithSpacing()});
  }
  for (std::size_t h = 0; h < handles; ++h) {
    draw_part(editor, name_of_handle(editor.state(), h).c_str(), {Role::handle, h}, kHandleColor);
  }
  if (scrolls) ImGui::EndChild();
  draw_part(editor, handles == 0 ? "handle" : "one more handle", {Role::handle, handles},
            kHandleColor);
  draw_part(editor, "belt", {Role::belt}, kBeltColor);
}

void draw_tools(Editor& editor) {
  std::size_t column = 0;
  for (const ToolRow& row : tool_rows()) {
    if (column > 0) ImGui::SameLine(static_cast<float>(column) * 6.5F * ImGui::GetFontSize());
    column = (column + 1) % 3;
    if (ImGui::RadioButton(row.name, editor.row() == &row)) editor.take(row);
  }
}

void draw_paint_options(Editor& editor) {
  PaintTool::Options& options = editor.paint_tool().options();
  ImGui::Checkbox("through", &options.through);
  ImGui::SameLine();
  ImGui::Checkbox("erase", &options.erase);
  if (options.shape != PaintTool::Shape::brush) return;
  float radius = static_cast<float>(options.radius);
  if (ImGui::SliderFloat("brush", &radius, 1.0F, 200.0F, "%.0f pixels")) options.radius = radius;
}

// One step of the history for a whole pull of the slider.
void draw_belt_width(Editor& editor, PanelDrafts& drafts) {
  const auto& fraction = editor.state().selection.belt_fraction;
  float percent = static_cast<float>(drafts.belt_percent.value_or(100.0 * fraction.value_or(0.0)));
  ImGui::SliderFloat("belt width", &percent, 0.0F, 50.0F,
                     fraction || drafts.belt_percent ? "%.0f %% of radius" : "chosen by hand");
  if (ImGui::IsItemActive()) drafts.belt_percent = static_cast<double>(percent);
  if (!ImGui::IsItemDeactivated()) return;
  const auto chosen = std::exchange(drafts.belt_percent, std::nullopt);
  if (chosen) editor.perform(SetBeltWidth{0.01 * *chosen});
}

// How firmly the handle in hand holds; one step of the history for a whole pull of a slider.
void draw_grading(Editor& editor, PanelDrafts& drafts) {
  const std::size_t handle = editor.handle();
  if (handle >= editor.state().selection.handles.size()) return;
  const Grading& now = editor.state().selection.handles[handle].grading;
  if (!now.field.empty()) {
    ImGui::TextDisabled("this handle holds by painted weights");
    return;
  }
  if (drafts.grading && drafts.grading->handle != handle) drafts.grading.reset();
  Grading grading = drafts.grading ? drafts.grading->grading : now;
  const Transition falloff = grading.falloff.value_or(Transition{});
  float width = static_cast<float>(falloff.width);
  float weight = static_cast<float>(grading.weight);
  const float longest = 0.25F * static_cast<float>(editor.shown().opened_bounds().diagonal());
  bool let_go = false;
  bool changed = ImGui::SliderFloat("falloff", &width, 0.0F, longest,
                                    width > 0.0F ? "%.3g" : "none", ImGuiSliderFlags_None);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("length beyond the handle over which its hold fades");
  }
  let_go = let_go || ImGui::IsItemDeactivatedAfterEdit();
  changed |=
      ImGui::SliderFloat("weight", &weight, 0.01F, 100.0F, "%.3g", ImGuiSliderFlags_Logarithmic);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("how firmly this handle holds, beside the surface and the others");
  }
  let_go = let_go || ImGui::IsItemDeactivatedAfterEdit();
  if (changed) {
    grading.weight = static_cast<double>(weight);
    grading.falloff.reset();
    if (width > 0.0F) grading.falloff = Transition{static_cast<double>(width), falloff.profile};
    drafts.grading = SetGrading{handle, grading};
  }
  if (!let_go) return;
  const auto chosen = std::exchange(drafts.grading, std::nullopt);
  if (chosen) editor.perform(*chosen);
}

enum class MirrorChoice { off, x, y, z, shape };

MirrorChoice choice_of(const std::optional<MirrorPlane>& plane) {
  if (!plane) return MirrorChoice::off;
  for (int axis = 0; axis < 3; ++axis) {
    if (*plane == MirrorPlane{Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(axis)}) {
      return static_cast<MirrorChoice>(1 + axis);
    }
  }
  return MirrorChoice::shape;
}

void draw_mirror(Editor& editor) {
  MirrorChoice choice = choice_of(editor.state().selection.mirror);
  if (!choose("mirror", choice,
              {{"off", MirrorChoice::off},
               {"x", MirrorChoice::x},
               {"y", MirrorChoice::y},
               {"z", MirrorChoice::z},
               {"shape", MirrorChoice::shape}})) {
    return;
  }
  if (choice == MirrorChoice::shape) return editor.mirror_by_shape();
  SetMirror command;
  if (choice != MirrorChoice::off) {
    const int axis = static_cast<int>(choice) - static_cast<int>(MirrorChoice::x);
    command.plane = MirrorPlane{Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(axis)};
  }
  editor.perform(command);
}

}  // namespace

void draw_selection_panel(Editor& editor, PanelDrafts& drafts) {
  draw_parts(editor);
  ImGui::Separator();
  draw_tools(editor);
  if (editor.has_in_hand(editor.paint_tool())) draw_paint_options(editor);
  if (ImGui::Button("New edit")) editor.new_edit();
  ImGui::SameLine();
  if (ImGui::Button("All")) editor.select_all();
  ImGui::SameLine();
  if (ImGui::Button("None")) editor.clear();
  if (ImGui::Button("Grow")) editor.grow();
  ImGui::SameLine();
  if (ImGui::Button("Shrink")) editor.shrink();
  ImGui::SameLine();
  if (ImGui::Button("Invert")) editor.invert();
  const Part& part = editor.part();
  if (part.role == Role::handle && part.handle < editor.state().selection.handles.size()) {
    ImGui::SameLine();
    if (ImGui::Button("Remove")) editor.remove_handle();
  }
  draw_belt_width(editor, drafts);
  draw_grading(editor, drafts);
  draw_mirror(editor);
}

}  // namespace lapwing::viewer
