#include <array>
#include <imgui.h>

#include "lapwing/recipe/step.h"
#include "state/waypoints.h"
#include "ui/draw_gizmo.h"
#include "ui/panels.h"
#include "ui/parameter_panel.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

// Accepts numbers such as 1e-3.
constexpr auto kNumber = ImGuiInputTextFlags_CharsScientific;

// Draws a field for each coordinate after its name, below `label`, which may be empty.
bool draw_vector(const char* label, const char* id, Eigen::Vector3d& vector,
                 const std::string& format, bool& let_go) {
  constexpr std::array kAxes{"X", "Y", "Z"};
  if (*label != '\0') ImGui::TextUnformatted(label);
  ImGui::PushID(id);
  const float spacing = ImGui::GetStyle().ItemInnerSpacing.x;
  const float letter = ImGui::CalcTextSize("X").x + spacing;
  const float width = (ImGui::GetContentRegionAvail().x - 2.0F * spacing) / 3.0F - letter;
  bool changed = false;
  for (int k = 0; k < 3; ++k) {
    if (k > 0) ImGui::SameLine(0.0F, spacing);
    const auto axis = static_cast<std::size_t>(k);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(kAxes[axis]);
    ImGui::SameLine(0.0F, spacing);
    ImGui::SetNextItemWidth(width);
    ImGui::PushID(k);
    changed |= ImGui::InputScalar("##number", ImGuiDataType_Double, &vector[k], nullptr, nullptr,
                                  format.c_str(), kNumber);
    ImGui::PopID();
    let_go = let_go || ImGui::IsItemDeactivatedAfterEdit();
  }
  ImGui::PopID();
  return changed;
}

bool draw_number(const char* label, double& number, const char* format, bool& let_go) {
  label_field(label);
  ImGui::PushID(label);
  const bool changed = ImGui::InputScalar("##number", ImGuiDataType_Double, &number, nullptr,
                                          nullptr, format, kNumber);
  ImGui::PopID();
  let_go = let_go || ImGui::IsItemDeactivatedAfterEdit();
  return changed;
}

// Sets rounding errors to 0, which would be long to read.
Eigen::Vector3d readable(const Eigen::Vector3d& vector, double size) {
  constexpr double kRounding = 1e-9;
  return (vector.array().abs() > kRounding * size).select(vector, 0.0);
}

// Draws the checkbox for a handle that turns freely.
void draw_orientation(Editor& editor, std::size_t handle) {
  const AppState& state = editor.state();
  if (!allows_free_handles(state.parameters)) return;
  const HandleMove& to = state.moves[handle];
  bool is_free = to.orientation == HandleOrientation::free;
  if (ImGui::Checkbox("Free rotation", &is_free)) {
    editor.actions().perform(
        MoveHandle{handle,
                   {is_free ? to.move : shown_move(state, handle),
                    is_free ? HandleOrientation::free : HandleOrientation::kept,
                    {}}});
  }
  explain(
      "The surface determines the rotation of the handle. Pulling the handle turns this on. The "
      "gizmo and a typed rotation turn it off.");
}

// A free handle stays free if only its position is typed. A typed rotation or scale fixes it.
HandleMove typed_move(const AppState& state, std::size_t handle, const SimilarityMove& typed) {
  const HandleMove& to = state.moves[handle];
  const Move shown = shown_move(state, handle);
  const auto* before = std::get_if<SimilarityMove>(&shown);
  const bool is_place_alone =
      before != nullptr && before->rotate == typed.rotate && before->scale == typed.scale;
  if (to.orientation == HandleOrientation::kept || !is_place_alone) return typed;
  return {typed, HandleOrientation::free, {}};
}

// Draws fields for the handle's move from rest.
void draw_move(Editor& editor, PanelDrafts& drafts, const std::string& unit) {
  const AppState& state = editor.state();
  const std::size_t handle = editor.tool().handle();
  if (handle >= state.moves.size()) return;
  ImGui::AlignTextToFramePadding();
  ImGui::Text("Handle %zu", handle + 1);
  ImGui::SameLine();
  if (ImGui::SmallButton("Reset")) editor.actions().perform(MoveHandle{handle, SimilarityMove{}});
  explain("Moves the handle back to its rest position.");
  draw_gizmo_panel(editor);
  const Move now = editor.tool().tools().gizmo.move() ? *editor.tool().tools().gizmo.move()
                                                      : shown_move(state, handle);
  const auto* similarity = std::get_if<SimilarityMove>(&now);
  if (similarity == nullptr) {
    ImGui::TextWrapped(
        "The handle is scaled along tilted axes, so its values cannot be edited. Use the gizmo, or "
        "click \"Reset\".");
    return;
  }
  SimilarityMove move = drafts.move.value_or(*similarity);
  move.translate = readable(move.translate, editor.bounds().diagonal());
  move.rotate.axis = readable(move.rotate.axis, 1.0);
  bool let_go = false;
  bool changed =
      draw_vector("Translation", "move", move.translate, with_unit("%.4g", unit), let_go);
  changed |= draw_number("Rotation", move.rotate.degrees, "%.5g°", let_go);
  explain("Angle of the rotation. Its axis is below.");
  changed |= draw_vector("", "axis", move.rotate.axis, "%.4g", let_go);
  changed |= draw_vector("Scale", "scale", move.scale, "%.4g", let_go);
  if (changed) drafts.move = move;
  draw_orientation(editor, handle);
  if (!let_go) return;
  drafts.move.reset();
  if (move.rotate.axis.norm() > 0.0 && move.scale.minCoeff() > 0.0)
    editor.actions().perform(MoveHandle{handle, typed_move(state, handle, move)});
}

void draw_parameters(Editor& editor, PanelDrafts& drafts) {
  if (!ImGui::TreeNode("Solver settings")) return;
  const EditParameters before = drafts.parameters.value_or(editor.state().parameters);
  EditParameters parameters = before;
  ParameterPanel panel(editor.bounds().diagonal());
  describe(parameters, panel);
  ImGui::TreePop();
  parameters = drafts.settling.meant(before, parameters);
  if (panel.edited()) drafts.parameters = parameters;
  if (!panel.chosen()) return;
  drafts.parameters.reset();
  editor.actions().perform(SetParameters{parameters});
}

}  // namespace

void draw_deform_panel(Editor& editor, PanelDrafts& drafts, const std::string& unit) {
  draw_move(editor, drafts, unit);
  if (editor.state().parameters.settle) {
    // Beside "Free rotation", if that is drawn.
    constexpr const char* kLabel = "Refine while dragging";
    const float right = ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x;
    const bool is_beside = editor.tool().handle() < editor.state().moves.size() &&
                           allows_free_handles(editor.state().parameters);
    if (is_beside) stay_on_line(button_width(kLabel) + ImGui::GetFrameHeight(), right);
    bool continuous = editor.drag().settles();
    if (ImGui::Checkbox(kLabel, &continuous)) {
      editor.drag().set_wants_to_settle(continuous);
    }
    explain("Shows the final result during a drag, as far as time allows. Off: a rough preview.");
  }
  draw_parameters(editor, drafts);
}

}  // namespace lapwing::viewer
