#include <array>
#include <cstdio>
#include <imgui.h>

#include "lapwing/step/step.h"
#include "ui/gizmo_panel.h"
#include "ui/panels.h"
#include "ui/parameter_panel.h"

namespace lapwing::viewer {
namespace {

using Phase = PreparationStatus::Phase;

const char* words(Phase phase, bool is_exact) {
  switch (phase) {
    case Phase::idle:
      return "choose an ROI and a handle";
    case Phase::previewing:
      return "preparing the preview";
    case Phase::solving:
      return "preview ready; preparing the exact response";
    case Phase::ready:
      return is_exact ? "exact response ready" : "preview ready; too large for the exact response";
    case Phase::settling:
      return "settling";
    case Phase::failed:
      return "cannot be prepared";
  }
  return "";
}

const char* words_of_surface(const Editor& editor) {
  if (editor.shows_live_result()) return "shown: the settled surface";
  switch (editor.surface().source()) {
    case SurfaceSource::still:
      return "shown: the current surface";
    case SurfaceSource::preview:
      return "shown: a preview, details do not turn yet";
    case SurfaceSource::exact:
      return "shown: the linear response, not settled";
  }
  return "";
}

void draw_progress(Editor& editor) {
  EditSession& session = editor.session();
  PreparationStatus status = session.preparation().status();
  // What settles as it is dragged comes and goes with every frame.
  if (status.phase == Phase::settling && editor.is_dragging()) status.phase = Phase::ready;
  const auto exact = session.preparation().exact();
  ImGui::TextWrapped("%s", words(status.phase, exact == nullptr || exact->is_exact()));
  if (!status.message.empty()) ImGui::TextWrapped("%s", status.message.c_str());
  if (editor.handles_leave_roi() && ImGui::Button("Enlarge the ROI")) editor.enlarge_roi();
  const bool prepares = status.phase == Phase::previewing || status.phase == Phase::solving;
  if (prepares || status.phase == Phase::settling) {
    const float share = static_cast<float>(status.fraction);
    ImGui::ProgressBar(share, {-5.0F * ImGui::GetFontSize(), 0.0F}, status.stage.c_str());
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) {
      prepares ? session.cancel_preparation() : session.cancel_settling();
    }
  } else if (status.phase == Phase::ready && needs_settling(editor.state()) &&
             !editor.is_dragging()) {
    if (ImGui::Button("Settle")) editor.settle();
  } else if (status.phase == Phase::idle && !editor.state().selection.handles.empty()) {
    if (ImGui::Button("Prepare")) session.prepare();
  }
  ImGui::TextDisabled("%s", words_of_surface(editor));
}

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

// Without what rounding leaves, which would be long to read.
Eigen::Vector3d readable(const Eigen::Vector3d& vector, double size) {
  constexpr double kRounding = 1e-9;
  return (vector.array().abs() > kRounding * size).select(vector, 0.0);
}

// The handle's move from its rest position, typed in.
void draw_move(Editor& editor, PanelDrafts& drafts) {
  const AppState& state = editor.state();
  const std::size_t handle = editor.handle();
  if (handle >= state.moves.size()) return;
  ImGui::Separator();
  ImGui::Text("handle %zu", handle + 1);
  ImGui::SameLine();
  if (ImGui::SmallButton("back to rest")) editor.perform(MoveHandle{handle, SimilarityMove{}});
  draw_gizmo_panel(editor);
  const Move& now = editor.gizmo_tool().move() ? *editor.gizmo_tool().move() : state.moves[handle];
  const auto* similarity = std::get_if<SimilarityMove>(&now);
  if (similarity == nullptr) {
    ImGui::TextDisabled("stretched along axes: moved by a matrix");
    return;
  }
  SimilarityMove move = drafts.move.value_or(*similarity);
  move.translate = readable(move.translate, editor.bounds().diagonal());
  move.rotate.axis = readable(move.rotate.axis, 1.0);
  bool let_go = false;
  bool changed = draw_vector("move", move.translate, let_go);
  changed |= draw_vector("axis", move.rotate.axis, let_go);
  changed |= draw_number("degrees", move.rotate.degrees, let_go);
  changed |= draw_number("scale", move.scale, let_go);
  if (changed) drafts.move = move;
  if (!let_go) return;
  drafts.move.reset();
  if (move.rotate.axis.norm() > 0.0 && move.scale > 0.0) editor.perform(MoveHandle{handle, move});
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

void draw_number_line(const char* label, const char* format, double number) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, number);
  ImGui::TextDisabled("%s", label);
  ImGui::SameLine(9.0F * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.data());
}

// What the result promises; the vertices to be shown.
std::optional<std::vector<Index>> draw_certificate(const Editor& editor) {
  std::optional<std::vector<Index>> shown;
  const Certificate* certificate = editor.session().certificate();
  if (certificate == nullptr) return shown;
  ImGui::Separator();
  if (editor.state().parameters.settle) {
    draw_number_line("balance", "%.1e", certificate->relative_gradient);
    draw_number_line("iterations", "%.0f", certificate->settle_iterations);
  } else {
    draw_number_line("residual", "%.1e", certificate->relative_residual);
  }
  draw_number_line("largest turn", "%.1f degrees", certificate->largest_rotation_degrees);
  draw_number_line("detail error", "%.3f", certificate->detail_error);
  draw_number_line("edge stretch", "%.3f", certificate->edge_stretch);
  int number = 0;
  for (const CertificateWarning& warning : editor.warnings()) {
    ImGui::PushID(number++);
    ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(242, 194, 77, 255));
    ImGui::TextWrapped("%s", warning.text.c_str());
    ImGui::PopStyleColor();
    if (!warning.vertices.empty() && ImGui::SmallButton("show me")) shown = warning.vertices;
    ImGui::PopID();
  }
  return shown;
}

}  // namespace

std::optional<std::vector<Index>> draw_deform_panel(Editor& editor, PanelDrafts& drafts) {
  ImGui::PushItemWidth(11.0F * ImGui::GetFontSize());
  draw_progress(editor);
  if (editor.state().parameters.settle) {
    bool continuous = editor.settles_while_dragging();
    if (ImGui::Checkbox("settle while dragging", &continuous)) {
      editor.set_settles_while_dragging(continuous);
    }
  }
  draw_move(editor, drafts);
  auto shown = draw_certificate(editor);
  draw_parameters(editor, drafts);
  ImGui::PopItemWidth();
  return shown;
}

}  // namespace lapwing::viewer
