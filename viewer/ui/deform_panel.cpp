#include <imgui.h>

#include "lapwing/recipe/step.h"
#include "state/waypoints.h"
#include "ui/draw_gizmo.h"
#include "ui/panels.h"
#include "ui/parameter_panel.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

bool draw_vector(const char* label, Eigen::Vector3d& vector, bool& let_go) {
  const bool changed =
      ImGui::InputScalarN(label, ImGuiDataType_Double, vector.data(), 3, nullptr, nullptr, "%.5g");
  let_go = let_go || ImGui::IsItemDeactivatedAfterEdit();
  return changed;
}

bool draw_number(const char* label, double& number, bool& let_go) {
  const bool changed =
      ImGui::InputScalar(label, ImGuiDataType_Double, &number, nullptr, nullptr, "%.5g");
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
  if (ImGui::Checkbox("turns freely", &is_free)) {
    editor.perform(MoveHandle{handle,
                              {is_free ? to.move : shown_move(state, handle),
                               is_free ? HandleOrientation::free : HandleOrientation::kept,
                               {}}});
  }
  explain(
      "The handle keeps its shape and goes where it is put, but turns as the surface wants. A pull "
      "of the handle sets this; its gizmo and a typed turn clear it.");
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
void draw_move(Editor& editor, PanelDrafts& drafts) {
  const AppState& state = editor.state();
  const std::size_t handle = editor.handle();
  if (handle >= state.moves.size()) return;
  ImGui::Text("handle %zu", handle + 1);
  ImGui::SameLine();
  if (ImGui::SmallButton("back to rest")) editor.perform(MoveHandle{handle, SimilarityMove{}});
  explain("Puts the handle where it was before it was moved.");
  draw_gizmo_panel(editor);
  const Move now =
      editor.gizmo_tool().move() ? *editor.gizmo_tool().move() : shown_move(state, handle);
  const auto* similarity = std::get_if<SimilarityMove>(&now);
  if (similarity == nullptr) {
    ImGui::TextDisabled("scaled along tilted axes: moved by a matrix");
    return;
  }
  SimilarityMove move = drafts.move.value_or(*similarity);
  move.translate = readable(move.translate, editor.bounds().diagonal());
  move.rotate.axis = readable(move.rotate.axis, 1.0);
  bool let_go = false;
  bool changed = draw_vector("move", move.translate, let_go);
  changed |= draw_vector("axis", move.rotate.axis, let_go);
  changed |= draw_number("degrees", move.rotate.degrees, let_go);
  changed |= draw_vector("scale", move.scale, let_go);
  if (changed) drafts.move = move;
  draw_orientation(editor, handle);
  if (!let_go) return;
  drafts.move.reset();
  if (move.rotate.axis.norm() > 0.0 && move.scale.minCoeff() > 0.0)
    editor.perform(MoveHandle{handle, typed_move(state, handle, move)});
}

void draw_parameters(Editor& editor, PanelDrafts& drafts) {
  if (!ImGui::TreeNode("How it is computed")) return;
  const EditParameters before = drafts.parameters.value_or(editor.state().parameters);
  EditParameters parameters = before;
  ParameterPanel panel(editor.bounds().diagonal());
  describe(parameters, panel);
  ImGui::TreePop();
  parameters = drafts.settling.meant(before, parameters);
  if (panel.edited()) drafts.parameters = parameters;
  if (!panel.chosen()) return;
  drafts.parameters.reset();
  editor.perform(SetParameters{parameters});
}

}  // namespace

void draw_deform_panel(Editor& editor, PanelDrafts& drafts) {
  ImGui::PushItemWidth(0.55F * ImGui::GetContentRegionAvail().x);
  draw_move(editor, drafts);
  if (editor.state().parameters.settle) {
    bool continuous = editor.settles_while_dragging();
    if (ImGui::Checkbox("settle while dragging", &continuous)) {
      editor.set_settles_while_dragging(continuous);
    }
    explain("A drag shows what it comes to, settled on the way as far as there is time.");
  }
  draw_parameters(editor, drafts);
  ImGui::PopItemWidth();
}

}  // namespace lapwing::viewer
