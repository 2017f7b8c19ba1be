#include <array>
#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <optional>
#include <utility>

#include "editing/editor_actions.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

using Phase = PreparationStatus::Phase;

const char* words_of_ready(const Preparation& preparation) {
  const Preparation::ToDragBy drag_by = preparation.drag_response();
  if (drag_by.response == nullptr || drag_by.is_exact) return "Ready";
  return drag_by.response->why_not_exact().empty()
             ? "Ready: refines while dragging"
             : "Rough preview ready: the region is too large to refine while dragging";
}

const char* words(Phase phase, const Preparation& preparation, bool has_handle) {
  switch (phase) {
    case Phase::idle:
      return has_handle ? "Not prepared" : "Select a region and a handle";
    case Phase::previewing:
      return "Preparing the preview";
    case Phase::solving:
      return "Preview ready, preparing the solver";
    case Phase::ready:
      return words_of_ready(preparation);
    case Phase::settling:
      return "Refining";
    case Phase::failed:
      return "The edit cannot be prepared";
  }
  return "";
}

const char* words_of_surface(const Editor& editor) {
  if (editor.drag().shows_live_result()) return "Refined surface";
  switch (editor.view().device().source()) {
    case SurfaceSource::still:
      return "Current surface";
    case SurfaceSource::preview:
      return "Rough preview";
    case SurfaceSource::exact:
      return "Linear response, not refined";
  }
  return "";
}

void draw_progress(Editor& editor) {
  EditSession& session = editor.session();
  PreparationStatus status = session.preparation().status();
  // During a drag the surface settles in every frame, so the phase would flicker.
  if (status.phase == Phase::settling && editor.tool().is_dragging()) status.phase = Phase::ready;
  ImGui::TextWrapped(
      "%s", words(status.phase, session.preparation(), !editor.state().selection.handles.empty()));
  if (!status.message.empty()) ImGui::TextWrapped("%s", in_window_words(status.message).c_str());
  if (handles_leave_roi(editor.state().selection) && ImGui::Button("Enlarge region"))
    enlarge_roi(editor);
  const bool prepares = status.phase == Phase::previewing || status.phase == Phase::solving;
  if (prepares || status.phase == Phase::settling) {
    const float share = static_cast<float>(status.fraction);
    ImGui::ProgressBar(share, {-5.0F * ImGui::GetFontSize(), 0.0F},
                       stage_in_words(status.stage).data());
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) {
      prepares ? session.cancel_preparation() : session.cancel_settling();
    }
  } else if (status.phase == Phase::ready && needs_settling(editor.state()) &&
             !editor.tool().is_dragging()) {
    if (ImGui::Button("Refine")) editor.session().prepare();
  } else if (status.phase == Phase::idle && !editor.state().selection.handles.empty()) {
    if (ImGui::Button("Prepare")) session.prepare();
  }
  ImGui::TextDisabled("%s", words_of_surface(editor));
}

void draw_missing_hold(Editor& editor) {
  draw_colored(Tone::warning,
               "Nothing holds the surface, so it moves as a whole with the handle. Select a fixed "
               "border, add a second handle, or select a smaller region.");
  if (ImGui::SmallButton("Select fixed border")) editor.tool().begin_choosing({Part::Role::belt});
  explain(Action::choose_belt);
}

// Draws one number of the certificate, in half a line.
void draw_number(const char* label, const char* format, double number, const char* meaning) {
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", label);
  explain(meaning);
  ImGui::TableNextColumn();
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, number);
  ImGui::TextUnformatted(std::isnan(number) ? "None" : text.data());
}

void draw_numbers(const Editor& editor, const Certificate& certificate) {
  if (!ImGui::BeginTable("certificate", 4, ImGuiTableFlags_SizingFixedFit)) return;
  if (editor.state().parameters.settle) {
    draw_number("Residual force", "%.0e", certificate.relative_gradient,
                "Remaining gradient of the energy, relative to its value before refining. 0 is "
                "equilibrium.");
    draw_number("Iterations", "%.0f", certificate.settle_iterations,
                "Number of iterations used to refine.");
  } else {
    draw_number("Residual", "%.0e", certificate.relative_residual,
                "Residual of the linear system, relative to its right-hand side.");
    ImGui::TableNextRow();
  }
  draw_number("Rotation", "%.1f°", certificate.largest_rotation_degrees,
              "Largest rotation of the surface at a vertex, from rest.");
  draw_number("Detail error", "%.3f", certificate.detail_error,
              "Share of the detail that is lost. A flat surface has no detail.");
  draw_number("Stretch", "%.3f", certificate.edge_stretch,
              "Mean change of the edge lengths, relative to rest.");
  ImGui::EndTable();
}

struct WarningWish {
  bool show = false;  // the warning's vertices
  std::optional<Remedy> remedy;
};

WarningWish draw_warning(const CertificateWarning& warning) {
  WarningWish wish;
  draw_colored(Tone::warning, warning.text);
  const float right = right_end();
  if (!warning.vertices.empty()) {
    wish.show = ImGui::SmallButton("Show");
    explain("Frames these vertices and marks them.");
  }
  bool first = warning.vertices.empty();
  for (const Remedy remedy : warning.remedies) {
    if (!std::exchange(first, false)) stay_on_line(button_width(label_of(remedy)), right);
    if (ImGui::SmallButton(label_of(remedy))) wish.remedy = remedy;
    explain(explanation_of(remedy));
  }
  return wish;
}

}  // namespace

ResultWish draw_result_panel(Editor& editor, bool points) {
  ResultWish wish;
  draw_progress(editor);
  if (editor.moves_as_a_whole()) draw_missing_hold(editor);
  if (points) {
    wish.back = ImGui::SmallButton("Previous view");
    explain("Returns to the view before \"Show\".", "Shortcut: Escape");
  }
  const Certificate* certificate = editor.session().certificate();
  if (certificate == nullptr) return wish;
  draw_numbers(editor, *certificate);
  std::optional<Remedy> remedy;
  int number = 0;
  for (const CertificateWarning& warning : editor.warnings()) {
    ImGui::PushID(number++);
    const WarningWish of_warning = draw_warning(warning);
    if (of_warning.show) wish.show = warning.vertices;
    if (of_warning.remedy) remedy = of_warning.remedy;
    ImGui::PopID();
  }
  if (remedy) carry_out(editor, *remedy);  // replaces the warnings
  return wish;
}

}  // namespace lapwing::viewer
