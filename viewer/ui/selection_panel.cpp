#include <algorithm>
#include <array>
#include <imgui.h>
#include <utility>

#include "editing/editor_actions.h"
#include "ui/mirror_choice.h"
#include "ui/panels.h"
#include "ui/widgets.h"

namespace lapwing::viewer {
namespace {

using Role = Part::Role;

// Draws a row that chooses a handle, with the colour of handles on the surface.
void draw_part(Editor& editor, const char* name, const Part& part) {
  ImGui::PushID(name);
  draw_swatch(kHandleColor);
  if (ImGui::RadioButton(name, editor.tool().part() == part)) editor.tool().choose(part);
  const std::size_t count = editor.tool().count(part);
  if (count > 0) {
    ImGui::SameLine();
    ImGui::TextDisabled("%zu", count);
  }
  ImGui::PopID();
}

std::string name_of_handle(const AppState& state, std::size_t h) {
  const ChosenHandle& handle = state.selection.handles[h];
  if (!is_pin(handle)) return "Handle " + std::to_string(h + 1);
  return "Pin " + std::to_string(h + 1) + ", vertex " + std::to_string(handle.vertices.front());
}

// Draws all handles, and a row for one more. A long list scrolls, so that what follows stays in
// place.
void draw_handles(Editor& editor) {
  const std::size_t handles = editor.state().selection.handles.size();
  constexpr std::size_t kRowsShown = 6;
  const bool scrolls = handles > kRowsShown;
  if (scrolls) {
    ImGui::BeginChild("handles", {0.0F, kRowsShown * ImGui::GetFrameHeightWithSpacing()});
  }
  for (std::size_t h = 0; h < handles; ++h) {
    draw_part(editor, name_of_handle(editor.state(), h).c_str(), {Role::handle, h});
  }
  if (scrolls) ImGui::EndChild();
  if (handles == 0) return;
  draw_part(editor, "Add handle", {Role::handle, handles});
  explain(Action::add_handle);
}

void draw_parts(Editor& editor) {
  const std::size_t roi = editor.tool().count({Role::roi});
  if (roi == 0) {
    ImGui::TextDisabled("Nothing selected");
  } else {
    ImGui::TextDisabled("Region %zu, fixed border %zu vertices", roi,
                        editor.tool().count({Role::belt}));
  }
  draw_handles(editor);
}

void draw_paint_options(PaintTool::Options& options) {
  ImGui::Checkbox("Select through", &options.through);
  explain("Also paints vertices that the surface hides.");
  ImGui::SameLine();
  ImGui::Checkbox("Erase", &options.erase);
  explain("Erases instead of painting.", "Shortcut: Ctrl while painting");
  if (options.shape != PaintTool::Shape::brush) return;
  float radius = static_cast<float>(options.radius_pt);
  label_field("Brush radius");
  if (ImGui::SliderFloat("##brush", &radius, 1.0F, 200.0F, "%.0f pt")) options.radius_pt = radius;
  explain("Radius of the brush.", "Shortcut: [ and ], Ctrl+wheel");
}

void draw_stiffness_options(Editor& editor) {
  StiffnessPaint& paint = editor.tool().tools().stiffness;
  ImGui::Checkbox("Rigid", &paint.is_rigid);
  explain("Each connected rigid part, such as a bone or a tooth, moves as one body.");
  if (!paint.is_rigid) {
    float factor = static_cast<float>(paint.factor);
    label_field("Stiffness");
    if (ImGui::SliderFloat("##stiffness", &factor, 0.01F, 100.0F, "%.3g",
                           ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
      paint.factor = std::clamp(static_cast<double>(factor), kSoftest, kStiffest);
    }
    explain("How many times stiffer than the rest. Below 1: softer.");
  }
  draw_paint_options(paint.brush());
  if (editor.state().selection.stiffness.empty()) return;
  if (ImGui::Button("Remove stiffness")) editor.actions().perform(SetStiffness{});
}

// A whole drag of the slider is one step of the history.
void draw_belt_width(Editor& editor, PanelDrafts& drafts) {
  const auto& fraction = editor.state().selection.belt_fraction;
  float percent = static_cast<float>(drafts.belt_percent.value_or(100.0 * fraction.value_or(0.0)));
  label_field("Fixed border");
  ImGui::SliderFloat("##belt", &percent, 0.0F, 50.0F,
                     fraction || drafts.belt_percent ? "%.0f%% of radius" : "By hand");
  explain("Width of the fixed border, relative to the radius of the region.");
  if (ImGui::IsItemActive()) drafts.belt_percent = static_cast<double>(percent);
  if (!ImGui::IsItemDeactivated()) return;
  const auto chosen = std::exchange(drafts.belt_percent, std::nullopt);
  if (chosen) editor.actions().perform(SetBeltWidth{0.01 * *chosen});
}

// Draws a checkbox that makes a handle soft and, for a soft handle, a slider for its weight. Sets
// `let_go` to true if the user clicks the checkbox or releases the slider. Returns whether the
// weight has changed.
bool draw_handle_weight(std::optional<double>& weight, bool& let_go) {
  bool is_soft = weight.has_value();
  bool changed = ImGui::Checkbox("Soft", &is_soft);
  explain("The surface can hold the handle back. Off: the handle reaches its target.");
  if (changed) {
    weight = is_soft ? std::optional(1.0) : std::nullopt;
    let_go = true;
  }
  if (!weight) return changed;
  place_field();
  float shown = static_cast<float>(*weight);
  if (ImGui::SliderFloat("##weight", &shown, 0.01F, 100.0F, "%.3g", ImGuiSliderFlags_Logarithmic)) {
    weight = static_cast<double>(shown);
    changed = true;
  }
  explain("Weight of the handle. A higher weight brings the handle closer to its target.");
  let_go = let_go || ImGui::IsItemDeactivatedAfterEdit();
  return changed;
}

// Draws how firmly the current handle holds. A whole drag of a slider is one step of the history.
void draw_falloff(Editor& editor, PanelDrafts& drafts, const std::string& unit) {
  const std::size_t handle = editor.tool().handle();
  if (handle >= editor.state().selection.handles.size()) return;
  const Falloff& now = editor.state().selection.handles[handle].falloff;
  if (!now.field.empty()) {
    ImGui::TextDisabled("Falloff: painted weights");
    return;
  }
  if (drafts.falloff && drafts.falloff->handle != handle) drafts.falloff.reset();
  Falloff falloff = drafts.falloff ? drafts.falloff->falloff : now;
  const Transition transition = falloff.transition.value_or(Transition{});
  float width = static_cast<float>(transition.width);
  const float longest =
      0.25F * static_cast<float>(editor.view().shown().opened_bounds().diagonal());
  bool let_go = false;
  label_field("Falloff");
  const std::string format = width > 0.0F ? with_unit("%.3g", unit) : "None";
  bool changed =
      ImGui::SliderFloat("##falloff", &width, 0.0F, longest, format.c_str(), ImGuiSliderFlags_None);
  explain("Distance from the handle over which its influence fades.");
  let_go = let_go || ImGui::IsItemDeactivatedAfterEdit();
  changed |= draw_handle_weight(falloff.weight, let_go);
  if (changed) {
    falloff.transition.reset();
    if (width > 0.0F)
      falloff.transition = Transition{static_cast<double>(width), transition.profile};
    drafts.falloff = SetFalloff{handle, falloff};
  }
  if (!let_go) return;
  const auto chosen = std::exchange(drafts.falloff, std::nullopt);
  if (chosen) editor.actions().perform(*chosen);
}

void draw_mirror(Editor& editor) {
  const std::optional<MirrorPlane>& now = editor.state().selection.mirror;
  // A plane that is not at an axis was found by the shape.
  std::optional<MirrorChoice> choice = MirrorChoice::off;
  if (now) choice = choice_of(*now).value_or(MirrorChoice::shape);
  const bool chosen = choose_mirror(choice);
  explain("Symmetry plane of the shape.", "Shortcut: Shift+M");
  if (!chosen) return;
  if (choice == MirrorChoice::shape) return mirror_by_shape(editor);
  SetMirror command{plane_of(*choice)};
  editor.actions().perform(command);
}

void draw_buttons(Editor& editor) {
  struct Button {
    const char* label;
    Action action;
  };
  constexpr std::array kButtons{Button{"New edit", Action::new_edit},
                                Button{"All", Action::select_all},
                                Button{"None", Action::clear},
                                Button{"Grow", Action::grow},
                                Button{"Shrink", Action::shrink},
                                Button{"Invert", Action::invert},
                                Button{"Remove handle", Action::remove_handle}};
  const float right = right_end();
  const Part& part = editor.tool().part();
  const bool has_handle =
      part.role == Role::handle && part.handle < editor.state().selection.handles.size();
  bool first = true;
  for (const Button& button : kButtons) {
    if (button.action == Action::remove_handle && !has_handle) continue;
    if (!first) stay_on_line(button_width(button.label), right);
    first = false;
    if (ImGui::Button(button.label)) perform_on(editor, button.action);
    explain(button.action);
  }
}

}  // namespace

void draw_selection_panel(Editor& editor, PanelDrafts& drafts, const std::string& unit) {
  draw_parts(editor);
  if (editor.tool().is(editor.tool().tools().paint))
    draw_paint_options(editor.tool().tools().paint.options());
  if (editor.tool().is(editor.tool().tools().stiffness)) draw_stiffness_options(editor);
  draw_buttons(editor);
  draw_belt_width(editor, drafts);
  draw_falloff(editor, drafts, unit);
  draw_mirror(editor);
}

}  // namespace lapwing::viewer
