#include "ui/gizmo_panel.h"

#include <array>
#include <imgui.h>

#include "ui/choose.h"
#include "ui/explain.h"

namespace lapwing::viewer {
namespace {

// In the order of GizmoPivot.
constexpr std::array kPivots{"its middle", "the middle of its rim", "the middle of the belt",
                             "a point of the surface", "the world's origin"};

void draw_pivot(Editor& editor, GizmoChoices& choices) {
  int pivot = static_cast<int>(choices.pivot);
  if (ImGui::Combo("turns about", &pivot, kPivots.data(), static_cast<int>(kPivots.size()))) {
    // There is no point to turn about before it is picked.
    if (static_cast<GizmoPivot>(pivot) == GizmoPivot::point) {
      editor.begin_picking_pivot();
    } else {
      choices.pivot = static_cast<GizmoPivot>(pivot);
    }
  }
  if (editor.picks_pivot()) ImGui::TextWrapped("%s", editor.hint());
  if (choices.pivot == GizmoPivot::point && !editor.picks_pivot() &&
      ImGui::SmallButton("another point")) {
    editor.begin_picking_pivot();
  }
}

}  // namespace

void draw_gizmo_panel(Editor& editor) {
  GizmoMode mode = editor.gizmo_tool().mode();
  if (choose("gizmo", mode,
             {{"move", GizmoMode::translate},
              {"turn", GizmoMode::rotate},
              {"scale", GizmoMode::scale}})) {
    editor.show_gizmo(mode);
  }
  GizmoChoices choices = editor.gizmo_choices();
  choose(
      "axes", choices.axes,
      {{"world", GizmoAxes::world}, {"its own", GizmoAxes::local}, {"normal", GizmoAxes::normal}});
  draw_pivot(editor, choices);
  ImGui::Checkbox("sticks to the surface", &choices.sticks_to_surface);
  explain("Moved, its middle goes where the cursor is on the surface beside the ROI.");
  editor.set_gizmo_choices(choices);
}

}  // namespace lapwing::viewer
