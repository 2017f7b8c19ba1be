// This file carries out what the tools return, starts a new edit when the user chooses a part
// elsewhere on the mesh, and sets the gizmo's axes and pivot. Actions that need the result of the
// last edit are postponed until it has settled.

#include <algorithm>
#include <array>
#include <utility>

#include "editing/editor.h"

namespace lapwing::viewer {
namespace {

using Role = Part::Role;

const char* const kBeginsHere = "New edit. Undo returns to the last one.";

}  // namespace

bool commits(const Command& command) {
  return is_one_of<Choose, Paint, Grab, RemoveHandle, Commit, NewEdit>(command);
}

// A handle lies in the ROI, so a disk for a handle outside it begins a new ROI.
void Editor::choose_elsewhere(const InputEvent& event, const ViewFrame& view) {
  const EditSelection& selection = state().selection;
  const bool may_be = has_in_hand(tools_.disk) && part_.role == Role::handle &&
                      event.button == MouseButton::left && !selection.mirror;
  if (!may_be || selection.roi.vertices.empty() || !shown_.has_triangles_of_state()) return;
  if (tools_.disk.is_at_grip(event.position, scene(view, view.projection()))) return;
  const auto pick = shown_.pick(view, event.position);
  if (!pick || std::ranges::binary_search(selection.roi.vertices, pick->vertex)) return;
  choose({Role::roi});
}

// Returns whether a stroke away from a finished edit chooses the ROI of another edit.
bool Editor::begins_elsewhere(const Command& command) const {
  const auto* stroke = std::get_if<Paint>(&command);
  if (stroke == nullptr || stroke->part.role != Role::roi || stroke->added.empty() ||
      !stroke->removed.empty() || !state().settled) {
    return false;
  }
  const VertexSet around =
      with_ring_neighbours(stroke->added, surface_of(state())->topology().rings);
  return intersect(around, state().selection.roi.vertices).empty();
}

void Editor::take_hold(const ToolAnswer& answer, const Eigen::Vector2d& pixel,
                       const Projection& projection) {
  if (!answer.holds || *answer.holds >= handle_count()) return;
  choose({Role::handle, *answer.holds});
  if (!answer.drags_held) return;
  tools_.gizmo.take_hold(pixel,
                         {state(), positions(), projection, {}, {}, part_, handle_, gizmo_keys_});
  begin_drag();
  drag_is_of_last_step_ = answer.command.has_value();
}

// `may_change` is true if the tool may still resize the chosen region, or extend it by a stroke.
Editor::Handled Editor::act_on(const ToolAnswer& answer, Joining joining, bool may_change) {
  if (!answer.message.empty()) say_({answer.message, Tone::warning});
  if (answer.command) {
    const Part part = part_;
    if (begins_elsewhere(*answer.command) && perform(NewEdit{})) {
      joining = Joining::with_last;
      say_(kBeginsHere);
    }
    const std::size_t done = session_->history().done();
    const bool sizes_on = answer.resizes && sizable_at_ == done;
    const bool is_done = perform(*answer.command, sizes_on ? Joining::instead_of_last : joining);
    const std::size_t expected = sizes_on || joining == Joining::with_last ? done : done + 1;
    if (is_done && session_->history().done() == expected && (may_change || answer.resizes)) {
      sizable_at_ = expected;
    }
    const bool is_choice = std::holds_alternative<Choose>(*answer.command);
    if (is_done && is_choice && !may_change && !answer.resizes && part_ == part) go_on();
  }
  return {answer.taken, answer.taken};
}

void Editor::say_what_was_let_go(std::size_t handles_before) {
  if (handle_count() >= handles_before) return;
  say_(handle_count() == 0 ? kBeginsHere
                           : "Handles outside the region were removed. Undo restores them.");
}

bool Editor::waits() const {
  return session_->awaits_result() || !postponed_.empty();
}

void Editor::postpone(std::function<void()> act) {
  if (postponed_.empty()) say_("Waiting until the last edit is refined. Undo cancels.");
  postponed_.push_back(std::move(act));
}

// Postpones the actions of a user who goes on while the last edit settles. Later actions wait, too,
// so that their order stays the same; the camera does not.
bool Editor::postpones(const InputEvent& event, const ViewFrame& view) {
  const bool begins = event.kind == InputKind::press && event.button == MouseButton::left &&
                      !postponed_.empty() && shown_.pick(view, event.position);
  const bool goes_on = postpones_drag_ && is_of_pointer(event);
  if (!begins && !goes_on) return false;
  if (event.kind == InputKind::press) postpones_drag_ = true;
  if (event.kind == InputKind::release) postpones_drag_ = false;
  postpone([this, event, view] { handle(event, view); });
  return true;
}

// Postpones the choice of a tool. A handle cannot be dragged before it is chosen.
bool Editor::postpones(const ToolAnswer& answer, const InputEvent& event, const ViewFrame& view) {
  if (!answer.command || !commits(*answer.command) || !waits()) return false;
  postpones_drag_ = answer.drags_held;
  const bool may_change = tool_->may_change_choice();
  postpone([this, answer, may_change, pixel = event.position, view] {
    act_on(answer, Joining::own_step, may_change);
    take_hold(answer, pixel, view.projection());
  });
  return true;
}

void Editor::run_postponed() {
  if (postponed_.empty() || session_->awaits_result()) return;
  postpones_drag_ = false;
  say_("");
  const auto acts = std::exchange(postponed_, {});
  for (const auto& act : acts) act();
}

void Editor::give_up_postponed() {
  postponed_.clear();
  postpones_drag_ = false;
}

const char* Editor::hint() const {
  if (picks_pivot_) return "Click on the surface to set the pivot. Escape cancels.";
  return tool_->hint(state(), part_);
}

void Editor::take_next_gizmo_axes() {
  // Indexed by GizmoAxes.
  constexpr std::array kSaid{"Orientation: World", "Orientation: Local", "Orientation: Normal"};
  GizmoChoices choices = gizmo_choices();
  const std::size_t next = (static_cast<std::size_t>(choices.axes) + 1) % kSaid.size();
  choices.axes = static_cast<GizmoAxes>(next);
  set_gizmo_choices(choices);
  say_(kSaid[next]);
}

void Editor::toggle_sticking() {
  GizmoChoices choices = gizmo_choices();
  choices.sticks_to_surface = !choices.sticks_to_surface;
  set_gizmo_choices(choices);
  say_(choices.sticks_to_surface ? "Snap to surface on" : "Snap to surface off");
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
