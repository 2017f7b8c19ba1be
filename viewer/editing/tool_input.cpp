#include "editing/tool_input.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace lapwing::viewer {

using Role = Part::Role;

ToolInput::ToolInput(const EditSession& session, ActiveTool& active, SurfaceView& view,
                     LiveDrag& drag, ActionQueue& actions, Say say)
    : session_(session),
      active_(active),
      view_(view),
      drag_(drag),
      actions_(actions),
      say_(std::move(say)) {}

ToolScene ToolInput::scene(const ViewFrame& view, const Projection& projection) {
  ShownSurface& shown = view_.shown();
  const auto pick = [&shown, &view](const Eigen::Vector2d& pixel) -> std::optional<SurfacePoint> {
    if (!shown.has_triangles_of_state()) return {};
    return shown.pick(view, pixel);
  };
  const auto is_visible = [this, &shown, &view, &projection](Index vertex) {
    return SeenVertices(shown.picture(view), surface_of(state())->topology(), shown.positions(),
                        projection)(vertex);
  };
  const Positions& seen = shown.follows() ? shown.positions_on_screen() : shown.positions();
  return {state(),    seen,           projection,       pick,
          is_visible, active_.part(), active_.handle(), gizmo_keys_};
}

ToolScene ToolInput::gizmo_scene(const Projection& projection) const {
  return {state(), view_.positions(), projection,       {},
          {},      active_.part(),    active_.handle(), gizmo_keys_};
}

Handled ToolInput::handle(const InputEvent& event, const ViewFrame& view) {
  if (is_of_pointer(event)) active_.tools().gizmo.move_cursor(event.position);
  // Alt and the left button rotate the view with every tool.
  if (event.kind == InputKind::press && event.modifiers.alt && !active_.is_dragging()) return {};
  if (postpones(event, view)) return {true, false};
  if (picks_pivot_ && pick_pivot(event, view)) return {true, true};
  const Projection projection = view.projection();
  if (const auto handled = handle_by_gizmo(event, view, projection)) return *handled;
  if (active_.is(active_.tools().gizmo)) return {};
  if (event.kind == InputKind::press) {
    return_to_triangles_of_state();
    choose_elsewhere(event, view);
  }
  SceneTool& tool = active_.scene_tool();
  const ToolAnswer answer = tool.handle(event, scene(view, projection));
  const bool grabs = answer.command && std::holds_alternative<Grab>(*answer.command);
  const bool chooses_roi = answer.holds && !grabs && state().selection.roi.vertices.empty();
  if (chooses_roi) actions_.perform(Choose{{Role::roi}, {AllVertices{}, "ROI"}});
  if (answer.taken) view_.renew_classes();
  if (postpones(answer, event, view)) return {true, true};
  Handled handled = act_on(answer, chooses_roi ? Joining::with_last : Joining::own_step,
                           active_.scene_tool().may_change_choice());
  take_hold(answer, event.position, projection);
  if (event.kind == InputKind::move) {
    handled.changed =
        handled.taken || active_.row() == nullptr || active_.scene_tool().follows_cursor();
  }
  return handled;
}

// Returns nullopt if the event is for the active tool.
std::optional<Handled> ToolInput::handle_by_gizmo(const InputEvent& event, const ViewFrame& view,
                                                  const Projection& projection) {
  const GizmoTool& gizmo = active_.tools().gizmo;
  // A panel's tool receives all keys.
  const bool keys = !is_of_pointer(event) && active_.row() != nullptr;
  const bool has_handle = active_.handle() < state().selection.handles.size();
  if (!has_handle || !(active_.has_gizmo() || gizmo.is_dragging() || keys)) return {};
  const GizmoPart before = gizmo.part();
  const bool was_dragging = gizmo.is_dragging();
  const ToolAnswer answer = send_to_gizmo(event, projection);
  if (answer.taken) {
    const bool gives_up = was_dragging && !gizmo.is_dragging() && !answer.command;
    if (gives_up && drag_.is_of_last_step() && active_.is(active_.tools().grab)) {
      actions_.undo();  // a grab that moves nothing is not a step
      return Handled{true, true};
    }
    return act_on(answer, drag_.is_of_last_step() ? Joining::with_last : Joining::own_step,
                  active_.scene_tool().may_change_choice());
  }
  if (!active_.has_gizmo()) return {};
  if (pull_handle(event, view, projection)) return Handled{true, true};
  return Handled{false, gizmo.part() != before};
}

ToolAnswer ToolInput::send_to_gizmo(const InputEvent& event, const Projection& projection) {
  GizmoTool& gizmo = active_.tools().gizmo;
  const bool was_dragging = gizmo.is_dragging();
  ToolScene scene = gizmo_scene(projection);
  scene.pick_still = [this, &projection](const Eigen::Vector2d& pixel) {
    return pick_beside_roi(projection.ray_through(pixel));
  };
  ToolAnswer answer = gizmo.handle(event, scene);
  if (gizmo.is_dragging() && !was_dragging) drag_.begin();
  if (was_dragging && !gizmo.is_dragging() && !answer.command) drag_.give_up();
  return answer;
}

// Drags a handle by its surface instead of its gizmo.
bool ToolInput::pull_handle(const InputEvent& event, const ViewFrame& view,
                            const Projection& projection) {
  const bool is_plain = !event.modifiers.control && !event.modifiers.shift && !event.modifiers.alt;
  if (event.kind != InputKind::press || event.button != MouseButton::left || !is_plain ||
      active_.tools().gizmo.is_dragging() || !view_.shown().has_triangles_of_state()) {
    return false;
  }
  const auto pick = view_.shown().pick(view, event.position);
  if (!pick) return false;
  const auto& handles = state().selection.handles;
  for (std::size_t h = 0; h < handles.size(); ++h) {
    if (!std::ranges::binary_search(handles[h].vertices, pick->vertex)) continue;
    take_hold({.holds = h, .drags_held = true}, event.position, projection);
    return true;
  }
  return false;
}

// Ignores the ROI, which may move away from the cursor or hide the new handle.
std::optional<SurfacePoint> ToolInput::pick_beside_roi(const Ray& ray) const {
  const VertexSet& roi =
      state().mirrored ? state().mirrored->region.roi : state().selection.roi.vertices;
  const Positions& positions = view_.positions();
  return pick_beside(surface_of(state())->topology(), positions, vertex_mask(positions.size(), roi),
                     ray);
}

// Returns whether the event was used to pick.
bool ToolInput::pick_pivot(const InputEvent& event, const ViewFrame& view) {
  if (event.kind == InputKind::key && event.key == kEscape) {
    picks_pivot_ = false;
    return true;
  }
  if (event.kind != InputKind::press || event.button != MouseButton::left) return false;
  const auto pick = view_.shown().pick(view, event.position);
  if (!pick) return false;  // for the camera
  GizmoTool& gizmo = active_.tools().gizmo;
  GizmoChoices choices = gizmo.choices();
  choices.pivot = GizmoPivot::point;
  choices.point = pick->position;
  gizmo.set_choices(choices);
  picks_pivot_ = false;
  return true;
}

// A tool may select vertices only on the surface that the user sees.
void ToolInput::return_to_triangles_of_state() {
  if (view_.shown().has_triangles_of_state() || active_.scene_tool().draws_preview()) return;
  view_.shown().end_preview();
  view_.show_before(false);
}

// A handle lies in the ROI, so a disk for a handle outside it begins a new ROI.
void ToolInput::choose_elsewhere(const InputEvent& event, const ViewFrame& view) {
  const EditSelection& selection = state().selection;
  DiskTool& disk = active_.tools().disk;
  const bool may_be = active_.is(disk) && active_.part().role == Role::handle &&
                      event.button == MouseButton::left && !selection.mirror;
  if (!may_be || selection.roi.vertices.empty() || !view_.shown().has_triangles_of_state()) return;
  if (disk.is_at_grip(event.position, scene(view, view.projection()))) return;
  const auto pick = view_.shown().pick(view, event.position);
  if (!pick || std::ranges::binary_search(selection.roi.vertices, pick->vertex)) return;
  active_.choose({Role::roi});
}

// Returns whether a stroke away from a finished edit chooses the ROI of another edit.
bool ToolInput::begins_elsewhere(const Command& command) const {
  const auto* stroke = std::get_if<Paint>(&command);
  if (stroke == nullptr || stroke->part.role != Role::roi || stroke->added.empty() ||
      !stroke->removed.empty() || !state().settled) {
    return false;
  }
  const VertexSet around =
      with_ring_neighbours(stroke->added, surface_of(state())->topology().rings);
  return intersect(around, state().selection.roi.vertices).empty();
}

// `may_change` is true if the tool may still resize the chosen region, or extend it by a stroke.
Handled ToolInput::act_on(const ToolAnswer& answer, Joining joining, bool may_change) {
  if (!answer.message.empty()) say_({answer.message, Tone::warning});
  if (answer.command) {
    const Part part = active_.part();
    if (begins_elsewhere(*answer.command) && actions_.perform(NewEdit{})) {
      joining = Joining::with_last;
      say_(kBeginsNewEdit);
    }
    const bool is_done =
        actions_.perform_choice(*answer.command, joining, answer.resizes, may_change);
    const bool is_choice = std::holds_alternative<Choose>(*answer.command);
    if (is_done && is_choice && !may_change && !answer.resizes && active_.part() == part) {
      active_.go_on();
    }
  }
  return {answer.taken, answer.taken};
}

void ToolInput::take_hold(const ToolAnswer& answer, const Eigen::Vector2d& pixel,
                          const Projection& projection) {
  if (!answer.holds || *answer.holds >= state().selection.handles.size()) return;
  active_.choose({Role::handle, *answer.holds});
  if (!answer.drags_held) return;
  active_.tools().gizmo.take_hold(pixel, gizmo_scene(projection));
  drag_.begin(answer.command.has_value());
}

// Postpones actions while the last edit settles. Later actions also wait, so that their order stays
// the same. Camera motions do not wait.
bool ToolInput::postpones(const InputEvent& event, const ViewFrame& view) {
  const bool begins = event.kind == InputKind::press && event.button == MouseButton::left &&
                      actions_.has_postponed() && view_.shown().pick(view, event.position);
  const bool goes_on = actions_.holds_press() && is_of_pointer(event);
  if (!begins && !goes_on) return false;
  if (event.kind == InputKind::press) actions_.set_holds_press(true);
  if (event.kind == InputKind::release) actions_.set_holds_press(false);
  actions_.postpone([this, event, view] { handle(event, view); });
  return true;
}

// Postpones the choice of a tool. A handle cannot be dragged before it is chosen.
bool ToolInput::postpones(const ToolAnswer& answer, const InputEvent& event,
                          const ViewFrame& view) {
  if (!answer.command || !commits(*answer.command) || !actions_.waits()) return false;
  actions_.set_holds_press(answer.drags_held);
  const bool may_change = active_.scene_tool().may_change_choice();
  actions_.postpone([this, answer, may_change, pixel = event.position, view] {
    act_on(answer, Joining::own_step, may_change);
    take_hold(answer, pixel, view.projection());
  });
  return true;
}

void ToolInput::click(const Eigen::Vector2d& pixel, const ViewFrame& view) {
  const ShownSurface& shown = view_.shown();
  const auto pick = view_.shown().pick(view, pixel);
  if (!pick) return say_("");
  const auto& handles = state().selection.handles;
  for (std::size_t h = 0; h < handles.size() && shown.has_triangles_of_state(); ++h) {
    if (std::ranges::binary_search(handles[h].vertices, pick->vertex)) {
      active_.choose({Role::handle, h});
    }
  }
  char text[128];
  std::snprintf(text, sizeof text, "Vertex %u, face %u at (%.5g, %.5g, %.5g)", pick->vertex,
                shown.topology().triangle_faces[pick->triangle], pick->position.x(),
                pick->position.y(), pick->position.z());
  say_(text);
}

const char* ToolInput::hint() const {
  if (picks_pivot_) return "Click on the surface to set the pivot. Escape cancels.";
  return active_.scene_tool().hint(state(), active_.part());
}

}  // namespace lapwing::viewer
