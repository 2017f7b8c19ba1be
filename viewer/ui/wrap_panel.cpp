// Draws the Wrap tab.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <imgui.h>

#include "state/whole_step.h"
#include "ui/mirror_choice.h"
#include "ui/panels.h"
#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

constexpr float kMostPairLines = 6.0F;
constexpr const char* kCoatDetail = "Coat with the scan's detail...";

// Draws the contents of the tab while no wrap is open: a button that opens a scan, and the wraps
// that can be edited.
void draw_beginnings(WrapTool& wrap, Editor& editor, WrapWish& wish) {
  ImGui::TextWrapped("Deforms the mesh so that it covers a scan.");
  if (ImGui::Button("Open scan...")) wish.path = PathPurpose::open_scan;
  const auto& steps = editor.state().steps;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const auto* step = std::get_if<WrapStep>(steps[k].get());
    if (step == nullptr) continue;
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::SmallButton("Edit")) wrap.take_up(editor, k);
    explain("Edits this step again. When you apply it, the steps after it run again.");
    ImGui::SameLine();
    ImGui::Text("%zu  %s", k + 1, describe(*steps[k]).c_str());
    if (ImGui::SmallButton(kCoatDetail)) wish.coat = step->scan;
    ImGui::PopID();
  }
}

void draw_pair_rows(WrapTool& wrap, Editor& editor) {
  const std::size_t count = wrap.landmarks().size();
  const float lines = std::min(static_cast<float>(count), kMostPairLines);
  ImGui::BeginChild("pairs", {0.0F, lines * ImGui::GetFrameHeightWithSpacing()});
  for (std::size_t k = 0; k < count; ++k) {
    ImGui::PushID(static_cast<int>(k));
    draw_swatch(color_of_pair(k));
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%zu", k + 1);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - button_width("Move") - button_width("Delete") -
                    ImGui::GetStyle().ItemSpacing.x);
    if (toggle_button("Move", wrap.moved() == k)) wrap.move(editor, k);
    explain("The next click on the template or on the scan moves the point there.");
    ImGui::SameLine();
    const bool removed = ImGui::Button("Delete");
    ImGui::PopID();
    if (!removed) continue;
    wrap.remove(k);
    break;
  }
  ImGui::EndChild();
}

void draw_landmarks(WrapTool& wrap, Editor& editor, WrapWish& wish) {
  ImGui::TextDisabled("Landmarks");
  if (!wrap.landmarks().empty()) draw_pair_rows(wrap, editor);
  if (toggle_button("Pick pairs", wrap.picks())) wrap.pick(!wrap.picks(), editor);
  explain(
      "Click a point of the template and the same point of the scan. Three pairs align the "
      "meshes; begin with the ends of limbs.",
      "Shortcut: K. Ctrl+Z removes the last pair.");
  const float right = right_end();
  stay_on_line(button_width("Load..."), right);
  if (ImGui::Button("Load...")) wish.path = PathPurpose::load_landmarks;
  explain("Loads pairs of points from a table or JSON file, or from two files of 3D Slicer.");
  stay_on_line(button_width("Save..."), right);
  ImGui::BeginDisabled(wrap.landmarks().empty());
  if (ImGui::Button("Save...")) wish.path = PathPurpose::save_landmarks;
  ImGui::EndDisabled();
}

void draw_mirror(std::optional<MirrorSpec>& mirror) {
  std::optional<MirrorChoice> choice = MirrorChoice::off;
  if (mirror) {
    const auto* plane = std::get_if<MirrorPlane>(&mirror->plane);
    choice = plane != nullptr ? choice_of(*plane) : MirrorChoice::shape;
  }
  const bool chosen = choose_mirror(choice);
  explain("The plane in which the template is symmetric. The result is symmetric, too.");
  if (!chosen) return;
  mirror.reset();
  if (choice == MirrorChoice::shape) mirror.emplace();
  if (const auto plane = plane_of(*choice)) mirror = MirrorSpec{*plane};
}

void draw_settings(WrapTool& wrap, const Editor& editor) {
  WrapSettings& settings = wrap.settings;
  choose("Alignment", settings.aligned, {{"Automatic", false}, {"Already aligned", true}});
  explain(
      "Automatic: uses the landmarks if there are at least three, otherwise compares the "
      "surfaces.");
  draw_mirror(settings.mirror);
  ImGui::Checkbox("Hold landmarks exactly", &settings.hard);
  explain("Off: landmarks are reached in the least-squares sense.");
  ImGui::Checkbox("Move onto the scan exactly", &settings.detail);
  explain(
      "At the end, each vertex that has a counterpart moves to the closest point of the scan. This "
      "also copies the noise of the scan.");
  const std::size_t parts = editor.state().selection.stiffness.size();
  ImGui::TextDisabled("Stiffness");
  ImGui::SameLine();
  ImGui::TextUnformatted(parts == 0 ? "Uniform" : "As painted");
  explain("Press Shift+P to paint parts that are rigid, stiffer or softer than the rest.");
}

void draw_colors(WrapTool& wrap, Editor& editor, const SurfaceStyle& style) {
  if (ImGui::Checkbox("Colour by distance (% of the diagonal)", &wrap.colors_by_distance))
    wrap.show_colors(editor);
  explain("The distance of the template from the scan, in percent of the scan's diagonal.");
  if (!wrap.colors_by_distance) return;
  SurfaceStyle legend = style;
  legend.range = editor.view().shown().measure_range();
  draw_legend(legend);
}

void draw_progress(const WrapTool& wrap, const WorkStatus& status) {
  char words[96];
  std::snprintf(words, sizeof words, "%s", stage_in_words(status.stage).data());
  if (status.stage == "wrap" && !wrap.reaches().empty()) {
    const std::size_t count = wrap.reaches().size();
    const std::size_t k = std::min(
        count - 1,
        static_cast<std::size_t>(std::lround(status.fraction * static_cast<double>(count))));
    std::snprintf(words, sizeof words, "Iteration %zu of %zu, reach %.2g%%", k + 1, count,
                  100.0 * wrap.reaches()[k]);
  }
  ImGui::ProgressBar(static_cast<float>(status.fraction), {-1.0F, 0.0F}, words);
  explain(
      "Springs pull the template onto the scan. Only deformations with a wavelength above the "
      "reach follow them. The reach decreases in each iteration. It is in percent of the "
      "template's diagonal.");
}

void draw_distance(const char* name, const SurfaceDistance& distance, double diagonal) {
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name);
  for (const double value : {distance.mean, distance.percentile_95, distance.max}) {
    ImGui::TableNextColumn();
    ImGui::Text("%.3g%%", 100.0 * value / diagonal);
  }
}

void draw_report(const WrapStepReport& report) {
  if (ImGui::BeginTable("distances", 4, ImGuiTableFlags_SizingStretchProp)) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("Distance");
    explain("In percent of the scan's diagonal.");
    for (const char* name : {"Mean", "95%", "Largest"}) {
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", name);
    }
    draw_distance("To scan", report.to_scan, report.scan_diagonal);
    draw_distance("From scan", report.to_template, report.scan_diagonal);
    ImGui::EndTable();
  }
  ImGui::TextWrapped("Coverage %.1f%%", 100.0 * report.coverage);
  explain("Share of the template's area that has a counterpart on the scan.");
  if (report.landmark_error > 0.0) {
    ImGui::TextWrapped("Largest landmark error %.3g%% (pair %zu)",
                       100.0 * report.landmark_error / report.scan_diagonal,
                       report.farthest_landmark + 1);
  }
  const auto& crossing = report.self_intersecting;
  ImGui::TextWrapped("Triangles: %zu flipped, %s self-intersecting", report.flipped_triangles,
                     crossing ? std::to_string(*crossing).c_str() : "too many");
}

// Draws the report with its warnings, or the reason why there is no result.
void draw_outcome(const WrapTool& wrap, const Editor& editor) {
  const StepPreview& preview = wrap.preview();
  if (!preview.message().empty()) draw_colored(Tone::error, in_window_words(preview.message()));
  const WrapStepReport* report = wrap.report();
  if (report == nullptr) return;
  if (!wrap.is_current(editor)) {
    draw_colored(Tone::warning, "The landmarks or settings have changed. Wrap again.");
  }
  for (const std::string& warning : preview.result()->warnings) {
    draw_colored(warning == report->trouble ? Tone::error : Tone::warning,
                 in_window_words(warning));
  }
  draw_report(*report);
}

}  // namespace

WrapWish draw_wrap_panel(WrapTool& wrap, Editor& editor, const SurfaceStyle& style) {
  WrapWish wish;
  if (!wrap.is_open()) {
    draw_beginnings(wrap, editor, wish);
    return wish;
  }
  if (wrap.taken_up()) {
    ImGui::TextWrapped("Editing step %zu. The steps after it run again when you apply it.",
                       *wrap.taken_up() + 1);
  }
  ImGui::Text("Scan: %s", wrap.scan().filename().string().c_str());
  if (ImGui::Button("Open another scan...")) wish.path = PathPurpose::open_scan;
  if (wrap.view() == nullptr) {
    ImGui::TextDisabled("%s", wrap.is_reading() ? "Reading the scan..." : "No scan");
    return wish;
  }
  ImGui::Separator();
  draw_landmarks(wrap, editor, wish);
  ImGui::Separator();
  draw_settings(wrap, editor);
  if (wrap.report() != nullptr) draw_colors(wrap, editor, style);
  return wish;
}

WrapWish draw_wrap_result(WrapTool& wrap, Editor& editor) {
  WrapWish wish;
  const WorkStatus status = wrap.preview().status();
  const bool has_result = wrap.report() != nullptr && wrap.is_current(editor);
  const float right = right_end();
  if (status.busy) {
    if (ImGui::Button("Stop")) wrap.cancel(editor);
    ImGui::SameLine();
    draw_progress(wrap, status);
  } else {
    ImGui::BeginDisabled(wrap.view() == nullptr);
    if (!has_result && ImGui::Button("Wrap")) wrap.wrap(editor);
    ImGui::EndDisabled();
    const bool applies = has_result && ImGui::Button("Apply");
    if (has_result) explain(Action::apply_step);
    ImGui::SameLine();
    const bool cancels = ImGui::Button("Cancel");
    explain("Closes the wrap. Its landmarks appear again when you open the same scan.",
            "Shortcut: Escape");
    if (has_result) {
      stay_on_line(button_width(kCoatDetail), right);
      if (ImGui::Button(kCoatDetail)) wish.coat = wrap.scan();
      explain("Applies the wrap and opens the Coat tab with the scan as its source.");
    }
    if (cancels) wrap.close(editor);
    if (applies || !wish.coat.empty()) wrap.apply(editor);
    if (!wrap.is_open()) return wish;
  }
  draw_outcome(wrap, editor);
  return wish;
}

}  // namespace lapwing::viewer
