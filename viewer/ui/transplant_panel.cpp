#include <algorithm>
#include <imgui.h>
#include <imgui_stdlib.h>
#include <optional>
#include <string>

#include "files/path_text.h"
#include "lapwing/recipe/step.h"
#include "state/whole_step.h"
#include "ui/panels.h"
#include "ui/parameter_panel.h"
#include "ui/widgets.h"
#include "work/window_words.h"

namespace lapwing::viewer {
namespace {

using Stage = PlaceTool::Stage;

// In letters of the font.
constexpr float kPictureLetters = 4.4F;
constexpr float kStripLetters = 13.0F;
constexpr float kRimLetters = 0.13F;
constexpr ImU32 kInHand = IM_COL32(255, 220, 90, 255);
constexpr ImU32 kHovered = IM_COL32(255, 240, 200, 160);

void draw_trouble(const std::string& text) {
  if (!text.empty()) draw_colored(Tone::warning, in_window_words(text));
}

// Draws the picture and name of a part. Returns true as soon as it is pressed.
bool draw_part(const PartLibraryView::Item& item, const UiPicture* picture, bool in_hand,
               float side) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 size{side, side + ImGui::GetTextLineHeight()};
  ImGui::InvisibleButton("part", size);
  const bool pressed = ImGui::IsItemActivated();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 corner{from.x + size.x, from.y + side};
  const float rounding = ImGui::GetStyle().FrameRounding;
  list.AddRectFilled(from, corner, ImGui::GetColorU32(ImGuiCol_FrameBg), rounding);
  if (picture != nullptr) list.AddImage(picture->id(), from, corner);
  if (in_hand || ImGui::IsItemHovered()) {
    list.AddRect(from, corner, in_hand ? kInHand : kHovered, rounding, 0,
                 kRimLetters * ImGui::GetFontSize());
  }
  list.PushClipRect(from, {from.x + size.x, from.y + size.y}, true);
  list.AddText({from.x, from.y + side}, ImGui::GetColorU32(ImGuiCol_Text), item.name.c_str());
  list.PopClipRect();
  if (item.trouble.empty()) {
    explain(item.file.string() + ", " + std::to_string(item.vertices) + " vertices",
            "Click it, or drag it onto the mesh. N picks up the next part.");
  } else {
    explain(item.trouble);
  }
  return pressed && item.trouble.empty();
}

bool is_in_hand(const TransplantTool& desk, const PartLibraryView::Item& item) {
  return desk.has_part() && desk.tool().draft().part->file == item.file;
}

void draw_strip(TransplantTool& desk, const PartPictures& pictures) {
  const float side = kPictureLetters * ImGui::GetFontSize();
  const auto items = desk.library().items();
  if (items.empty()) {
    ImGui::TextWrapped(
        "No parts in %s. Add a mesh file with a hole, or cut out a region, under \"More parts\".",
        with_tilde(desk.library().folder()).c_str());
    return;
  }
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const auto per_row =
      static_cast<std::size_t>(std::max(1.0F, ImGui::GetContentRegionAvail().x / (side + spacing)));
  const std::size_t rows = (items.size() + per_row - 1) / per_row;
  const float row = side + ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
  const float height =
      std::min(static_cast<float>(rows) * row, kStripLetters * ImGui::GetFontSize());
  std::optional<std::filesystem::path> taken;
  if (ImGui::BeginChild("parts", {0.0F, height})) {
    for (std::size_t k = 0; k < items.size(); ++k) {
      if (k % per_row != 0) ImGui::SameLine();
      ImGui::PushID(static_cast<int>(k));
      if (draw_part(items[k], pictures.of(k), is_in_hand(desk, items[k]), side)) {
        taken = items[k].file;
      }
      // The part was dragged out of the strip and released over the surface, where it stays.
      const bool outside = !ImGui::IsWindowHovered(ImGuiHoveredFlags_AnyWindow);
      if (ImGui::IsItemDeactivated() && outside) desk.tool().set_down();
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  if (taken) desk.take_part(*taken);
}

std::optional<PathPurpose> draw_more_parts(TransplantTool& desk, Editor& editor,
                                           PanelDrafts& drafts) {
  std::optional<PathPurpose> purpose;
  PartLibraryView& library = desk.library();
  if (!ImGui::TreeNode("More parts")) return purpose;
  ImGui::TextWrapped("Folder: %s", with_tilde(library.folder()).c_str());
  if (ImGui::Button("Choose folder...")) purpose = PathPurpose::parts_folder;
  if (ImGui::Button("Use file...")) purpose = PathPurpose::use_part;
  ImGui::SameLine();
  if (ImGui::Button("Add file...")) purpose = PathPurpose::add_part;
  ImGui::TextDisabled("Cut out the region as");
  ImGui::SetNextItemWidth(-4.0F * ImGui::GetFontSize());
  const bool entered =
      ImGui::InputText("##name", &drafts.part_name, ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  const AppState& state = editor.state();
  const bool can_cut = !state.selection.roi.vertices.empty() && !needs_settling(state);
  const bool cuts = ImGui::Button("Cut") || entered;
  if (cuts && can_cut && !drafts.part_name.empty()) {
    library.cut(state, spec_of(state.selection.roi, "the region"), drafts.part_name);
  }
  if (needs_settling(state)) {
    draw_trouble("The last move is not refined yet. Wait for its result, or undo it.");
  } else if (!can_cut) {
    ImGui::TextDisabled("Select a region to cut out.");
  } else if (drafts.part_name.empty()) {
    ImGui::TextDisabled("Type a name for the part.");
  }
  ImGui::TreePop();
  return purpose;
}

void draw_place(TransplantTool& desk, Editor& editor) {
  PlaceTool& tool = desk.tool();
  if (!editor.tool().is(tool)) {
    if (ImGui::Button("Place by hand")) editor.tool().lend(tool);
    ImGui::SameLine();
    ImGui::TextDisabled("Another tool is active.");
  } else if (tool.stage() == Stage::set_down) {
    if (ImGui::Button("Pick up (G)")) tool.carry();
    GizmoMode mode = tool.mode();
    choose("Gizmo", mode,
           {{"Move", GizmoMode::translate},
            {"Rotate", GizmoMode::rotate},
            {"Scale", GizmoMode::scale}});
    tool.show(mode);
  } else {
    ImGui::TextWrapped("%s", editor.input().hint());
    ImGui::Checkbox("Snap rim to surface", &tool.snaps);
  }
}

void draw_hole(TransplantTool& desk, const Editor& editor) {
  TransplantDraft& draft = desk.tool().draft();
  bool chosen = draft.chosen_hole.has_value() || desk.takes_roi();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("Hole");
  ImGui::SameLine();
  if (ImGui::RadioButton("Disk", !chosen)) desk.take_roi(false);
  // The hole of an earlier step does not follow the ROI that is chosen now.
  if (chosen || !desk.taken_up()) {
    ImGui::SameLine();
    const bool pressed = ImGui::RadioButton(desk.taken_up() ? "Unchanged" : "Region", chosen);
    if (pressed && !desk.taken_up()) desk.take_roi(true);
  }
  if (desk.takes_roi() && editor.state().selection.roi.vertices.empty()) {
    ImGui::TextDisabled("Select a region. Until then, the disk is used.");
  }
  if (draft.chosen_hole) return;
  float percent = static_cast<float>(100.0 * draft.hole_share);
  label_field("Hole size");
  if (ImGui::SliderFloat("##size", &percent, 50.0F, 300.0F, "%.0f%% of the rim")) {
    draft.hole_share = 0.01 * static_cast<double>(percent);
  }
}

void draw_computed(TransplantDraft& draft) {
  if (!ImGui::TreeNode("Seam settings")) return;
  std::optional<Transition>& transition = draft.parameters.transition;
  const bool had_transition = transition.has_value();
  const double radius = draft.stands ? draft.frame().radius : 0.0;
  // Sliders go to a quarter of this size, which is twice the radius.
  ParameterPanel panel(8.0 * radius);
  describe(draft.parameters, panel);
  if (transition && !had_transition) transition->width = 0.5 * radius;
  ImGui::TreePop();
}

void draw_draft(TransplantTool& desk, Editor& editor) {
  TransplantDraft& draft = desk.tool().draft();
  ImGui::Separator();
  const std::string name = draft.part->file.filename().string();
  ImGui::Text("%s, %zu vertices", name.empty() ? "This mesh" : name.c_str(),
              draft.part->mesh.vertex_count());
  if (desk.taken_up()) {
    ImGui::SameLine();
    ImGui::TextDisabled("Editing step %zu", *desk.taken_up() + 1);
  }
  draw_place(desk, editor);
  draw_hole(desk, editor);
  draw_computed(draft);
}

void draw_warnings(TransplantTool& desk, const TransplantResult& result) {
  if (!result.carried_out.report.transplant) return;
  const std::vector<Warning>& warnings = result.carried_out.report.transplant->warnings;
  TransplantDraft& draft = desk.tool().draft();
  // The list of texts also contains notes about the file of the part.
  for (const std::string& text : result.carried_out.warnings) {
    const auto found = std::ranges::find(warnings, text, &Warning::text);
    const Warning warning = found != warnings.end() ? *found : Warning{text};
    if (!draw_engine_warning(warning)) continue;
    if (warning.advice == Advice::set_transition_width) {
      std::optional<Transition>& transition = draft.parameters.transition;
      if (!transition) transition.emplace();
      transition->width = warning.value;
    } else {
      // A larger disk replaces a hole that was chosen as a region.
      draft.chosen_hole.reset();
      desk.take_roi(false);
      draft.hole_share = std::min(1.5 * draft.hole_share, 3.0);
    }
  }
}

void draw_steps(TransplantTool& desk, const Editor& editor) {
  const auto& steps = editor.state().steps;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (!std::holds_alternative<TransplantStep>(*steps[k])) continue;
    ImGui::PushID(static_cast<int>(k));
    if (ImGui::SmallButton("Edit")) desk.take_up(editor, k);
    explain("Edits this step again. When you apply it, the steps after it run again.");
    ImGui::SameLine();
    ImGui::Text("%zu  %s", k + 1, describe(*steps[k]).c_str());
    ImGui::PopID();
  }
}

}  // namespace

void PartPictures::renew(const PartLibraryView& library, gpu::Context& context) {
  if (version_ == library.version()) return;
  version_ = library.version();
  pictures_.clear();
  for (const PartLibraryView::Item& item : library.items()) {
    pictures_.push_back(item.picture ? std::make_unique<UiPicture>(context, *item.picture)
                                     : nullptr);
  }
}

void PartPictures::release() {
  pictures_.clear();
  version_ = 0;
}

std::optional<PathPurpose> draw_transplant_panel(TransplantTool& desk, const PartPictures& pictures,
                                                 Editor& editor, PanelDrafts& drafts) {
  draw_strip(desk, pictures);
  draw_trouble(desk.library().message());
  const auto purpose = draw_more_parts(desk, editor, drafts);
  if (!desk.is_open()) draw_steps(desk, editor);
  if (desk.has_part()) {
    draw_draft(desk, editor);
  } else if (desk.is_reading()) {
    ImGui::TextDisabled("Reading the part...");
  }
  return purpose;
}

void draw_transplant_result(TransplantTool& desk, Editor& editor) {
  const bool carries_out = editor.session().is_carrying_out();
  if (desk.tool().stage() == Stage::set_down && !carries_out) {
    if (ImGui::Button("Apply")) return desk.apply(editor);
    explain("Adds the transplant as a step.", "Shortcut: Enter");
    ImGui::SameLine();
  }
  if (ImGui::Button("Cancel")) {
    if (!carries_out) return desk.close(editor);
    editor.session().cancel_step();
  }
  explain("Discards the transplant.", "Shortcut: Escape");
  const TransplantPreview& preview = desk.preview();
  const WorkStatus applying = editor.session().step_status();
  const WorkStatus status = applying.busy ? applying : preview.status();
  if (status.busy) {
    ImGui::ProgressBar(static_cast<float>(status.fraction), {-1.0F, 0.0F},
                       stage_in_words(status.stage).data());
  } else if (const TransplantResult* result = preview.result()) {
    if (const auto& report = result->carried_out.report.transplant) {
      ImGui::TextWrapped("Seam: %zu triangles, %zu vertices blended", report->strip_triangles,
                         result->carried_out.report.free);
    }
    draw_warnings(desk, *result);
  }
  draw_trouble(preview.message());
}

}  // namespace lapwing::viewer
