#include <array>
#include <cmath>
#include <cstdio>
#include <imgui.h>

#include "ui/panels.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

using Phase = PreparationStatus::Phase;

const char* words_of_ready(const Preparation& preparation) {
  const Preparation::ToDragBy drag_by = preparation.drag_response();
  if (drag_by.response == nullptr || drag_by.is_exact) return "exact response ready";
  return drag_by.response->why_not_exact().empty()
             ? "ready: settles as it is dragged"
             : "preview ready; too large for the exact response";
}

const char* words(Phase phase, const Preparation& preparation, bool has_handle) {
  switch (phase) {
    case Phase::idle:
      return has_handle ? "not prepared" : "choose an ROI and a handle";
    case Phase::previewing:
      return "preparing the preview";
    case Phase::solving:
      return "preview ready; preparing the rest";
    case Phase::ready:
      return words_of_ready(preparation);
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
  // During a drag the surface settles in every frame, so the phase would flicker.
  if (status.phase == Phase::settling && editor.is_dragging()) status.phase = Phase::ready;
  ImGui::TextWrapped(
      "%s", words(status.phase, session.preparation(), !editor.state().selection.handles.empty()));
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

// Draws one number of the certificate, in half a line.
void draw_number(const char* label, const char* format, double number, const char* meaning) {
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", label);
  explain(meaning);
  ImGui::TableNextColumn();
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, number);
  ImGui::TextUnformatted(std::isnan(number) ? "none" : text.data());
}

void draw_numbers(const Editor& editor, const Certificate& certificate) {
  if (!ImGui::BeginTable("certificate", 4, ImGuiTableFlags_SizingFixedFit)) return;
  if (editor.state().parameters.settle) {
    draw_number("balance", "%.0e", certificate.relative_gradient,
                "How far the surface is from balance: the energy's gradient, beside that of the "
                "surface before it settled.");
    draw_number("iterations", "%.0f", certificate.settle_iterations, "Steps that settling took.");
  } else {
    draw_number("residual", "%.0e", certificate.relative_residual,
                "What the linear system leaves, beside its right-hand side.");
    ImGui::TableNextRow();
  }
  draw_number("turn", "%.1f deg", certificate.largest_rotation_degrees,
              "The largest rotation of a vertex's ring from rest.");
  draw_number("detail", "%.3f", certificate.detail_error,
              "How much of the details is lost: 0 for nothing. A flat surface has no details.");
  draw_number(
      "stretch", "%.3f", certificate.edge_stretch,
      "By how much edges are longer or shorter than at rest, in the mean: 0 for not at all.");
  ImGui::EndTable();
}

// Returns true if the user wants to see the warning's vertices.
bool draw_warning(const CertificateWarning& warning) {
  draw_colored(Tone::warning, warning.text);
  if (warning.vertices.empty()) return false;
  const bool pressed = ImGui::SmallButton("show me");
  explain("Frames these vertices and points at them.");
  return pressed;
}

}  // namespace

ResultWish draw_result_panel(Editor& editor, bool points) {
  ResultWish wish;
  draw_progress(editor);
  if (points) {
    wish.back = ImGui::SmallButton("back to the view before");
    explain("Looks from where you looked before you were shown these vertices (Escape).");
  }
  const Certificate* certificate = editor.session().certificate();
  if (certificate == nullptr) return wish;
  draw_numbers(editor, *certificate);
  int number = 0;
  for (const CertificateWarning& warning : editor.warnings()) {
    ImGui::PushID(number++);
    if (draw_warning(warning)) wish.show = warning.vertices;
    ImGui::PopID();
  }
  return wish;
}

}  // namespace lapwing::viewer
