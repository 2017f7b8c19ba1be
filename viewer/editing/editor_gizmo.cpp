// The gizmo's axes, pivot and sticking to the surface.

#include "editing/editor.h"

namespace lapwing::viewer {

const char* Editor::hint() const {
  if (picks_pivot_)
    return "click the place on the surface to turn about; Escape leaves it as it is";
  return tool_->hint(state(), part_);
}

void Editor::take_next_gizmo_axes() {
  GizmoChoices choices = gizmo_choices();
  switch (choices.axes) {
    case GizmoAxes::world:
      choices.axes = GizmoAxes::local;
      say_("the gizmo's axes are the handle's own");
      break;
    case GizmoAxes::local:
      choices.axes = GizmoAxes::normal;
      say_("the gizmo's z is along the normal of the handle");
      break;
    case GizmoAxes::normal:
      choices.axes = GizmoAxes::world;
      say_("the gizmo's axes are the world's");
      break;
  }
  set_gizmo_choices(choices);
}

void Editor::toggle_sticking() {
  GizmoChoices choices = gizmo_choices();
  choices.sticks_to_surface = !choices.sticks_to_surface;
  set_gizmo_choices(choices);
  say_(choices.sticks_to_surface ? "a handle that is moved sticks to the surface beside the ROI"
                                 : "a handle that is moved no longer sticks to the surface");
}

// Returns whether the event was used to pick.
bool Editor::pick_pivot(const InputEvent& event, const ViewFrame& view) {
  if (event.kind == InputKind::key && event.key == kEscape) {
    picks_pivot_ = false;
    return true;
  }
  if (event.kind != InputKind::press || event.button != MouseButton::left) return false;
  const auto pick = shown_.pick(view, event.position);
  if (!pick) return false;  // for the camera
  GizmoChoices choices = gizmo_choices();
  choices.pivot = GizmoPivot::point;
  choices.point = pick->position;
  set_gizmo_choices(choices);
  picks_pivot_ = false;
  return true;
}

// Leaves out the ROI, which may move or hide the place for the handle.
std::optional<SurfacePoint> Editor::pick_beside_roi(const Ray& ray) const {
  const VertexSet& roi =
      state().mirrored ? state().mirrored->region.roi : state().selection.roi.vertices;
  const std::vector<char> moves = vertex_mask(positions().size(), roi);
  return pick_beside(surface_of(state())->topology(), positions(), moves, ray);
}

}  // namespace lapwing::viewer
