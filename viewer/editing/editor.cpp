#include "editing/editor.h"

#include <algorithm>
#include <cstdio>

#include "editing/kernels_like.h"
#include "tools/selection_edits.h"

namespace lapwing::viewer {
namespace {

using Role = Part::Role;

// Leaves room for the surface between handle and belt.
constexpr int kRingsAroundHandle = 6;

// Returns the opened mesh with the triangles of the first state of the history.
std::shared_ptr<const Mesh> opened_surface(const EditStart& start) {
  const AppState first =
      start.history.last_state([](const AppState& state) { return state.steps.empty(); });
  if (first.rest->shares_faces_with(*start.opened)) return surface_of(first);
  return surface_of(open_state(start.opened));
}

}  // namespace

Editor::Editor(EditStart start, const std::shared_ptr<gpu::Context>& context, Say say,
               std::function<void()> wake)
    : say_(std::move(say)),
      shown_(opened_surface(start), {start.colors, start.opened}),
      attachment_follower_(wake) {
  session_ = std::make_unique<EditSession>(
      std::move(start.history), std::move(start.file), start.journals, kernels_like(context),
      std::move(wake), upload_to(context), start.restored ? &*start.restored : nullptr);
  if (!session_->warning().empty()) {
    say_({session_->warning(), Tone::warning});
  } else if (start.restored) {
    discard(*start.restored);
  }
  if (handle_count() > 0) {
    part_ = {Role::handle, 0};
    take(Action::take_move);
  }
  shown_.take(state());
  shown_.use_device(context);
  carried_.use_device(context);
  state_changed();
}

void Editor::release_device() {
  const GizmoChoices choices = tools_.gizmo.choices();
  tools_.gizmo = {};
  tools_.gizmo.set_choices(choices);
  session_->cancel_preparation();
  attachment_follower_.cancel();
  carried_.release_device();
  shown_.release_device();
}

void Editor::use_device(const std::shared_ptr<gpu::Context>& context) {
  session_->use_kernels(kernels_like(context), upload_to(context));
  shown_.use_device(context);
  carried_.use_device(context);
  state_changed();
}

bool Editor::is_dragging() const {
  return tools_.gizmo.is_dragging() || tool_->is_dragging();
}

ToolScene Editor::scene(const ViewFrame& view, const Projection& projection) {
  const auto pick = [this, &view](const Eigen::Vector2d& pixel) -> std::optional<SurfacePoint> {
    if (!shown_.has_triangles_of_state()) return {};
    return shown_.pick(view, pixel);
  };
  const auto is_visible = [this, &view, &projection](Index vertex) {
    return SeenVertices(shown_.picture(view), surface_of(state())->topology(), positions(),
                        projection)(vertex);
  };
  const Positions& seen = shown_.follows() ? shown_.positions_on_screen() : positions();
  return {state(), seen, projection, pick, is_visible, part_, handle_, gizmo_keys_};
}

Editor::Handled Editor::handle(const InputEvent& event, const ViewFrame& view) {
  if (is_of_pointer(event)) tools_.gizmo.move_cursor(event.position);
  // Alt and the left button turn the view with every tool.
  if (event.kind == InputKind::press && event.modifiers.alt && !is_dragging()) return {};
  if (postpones(event, view)) return {true, false};
  if (picks_pivot_ && pick_pivot(event, view)) return {true, true};
  const Projection projection = view.projection();
  // A panel's tool receives all keys.
  const bool keys = !is_of_pointer(event) && row_ != nullptr;
  if (handle_ < handle_count() && (has_gizmo() || tools_.gizmo.is_dragging() || keys)) {
    const GizmoPart before = tools_.gizmo.part();
    const bool was_dragging = tools_.gizmo.is_dragging();
    const ToolAnswer answer = send_to_gizmo(event, projection);
    if (answer.taken) {
      const bool gives_up = was_dragging && !tools_.gizmo.is_dragging() && !answer.command;
      if (gives_up && drag_is_of_last_step_ && has_in_hand(tools_.grab)) {
        undo();  // a grab that moves nothing is no step
        return {true, true};
      }
      return act_on(answer, drag_is_of_last_step_ ? Joining::with_last : Joining::own_step,
                    tool_->may_change_choice());
    }
    if (has_gizmo() && pull_handle(event, view, projection)) return {true, true};
    if (has_gizmo()) return {false, tools_.gizmo.part() != before};
  }
  if (has_in_hand(tools_.gizmo)) return {};
  if (event.kind == InputKind::press) {
    return_to_triangles_of_state();
    choose_elsewhere(event, view);
  }
  const ToolAnswer answer = tool_->handle(event, scene(view, projection));
  const bool grabs = answer.command && std::holds_alternative<Grab>(*answer.command);
  const bool chooses_roi = answer.holds && !grabs && state().selection.roi.vertices.empty();
  if (chooses_roi) perform(Choose{{Role::roi}, {AllVertices{}, "ROI"}});
  classes_are_old_ = classes_are_old_ || answer.taken;
  if (postpones(answer, event, view)) return {true, true};
  Handled handled = act_on(answer, chooses_roi ? Joining::with_last : Joining::own_step,
                           tool_->may_change_choice());
  take_hold(answer, event.position, projection);
  if (event.kind == InputKind::move) {
    handled.changed = handled.taken || row_ == nullptr || tool_->follows_cursor();
  }
  return handled;
}

// Drags a handle by its surface, beside its gizmo.
bool Editor::pull_handle(const InputEvent& event, const ViewFrame& view,
                         const Projection& projection) {
  const bool is_plain = !event.modifiers.control && !event.modifiers.shift && !event.modifiers.alt;
  if (event.kind != InputKind::press || event.button != MouseButton::left || !is_plain ||
      tools_.gizmo.is_dragging() || !shown_.has_triangles_of_state()) {
    return false;
  }
  const auto pick = shown_.pick(view, event.position);
  if (!pick) return false;
  const auto& handles = state().selection.handles;
  for (std::size_t h = 0; h < handles.size(); ++h) {
    if (!std::ranges::binary_search(handles[h].vertices, pick->vertex)) continue;
    take_hold({.holds = h, .drags_held = true}, event.position, projection);
    return true;
  }
  return false;
}

// The user must see the surface on which a tool chooses.
void Editor::return_to_triangles_of_state() {
  if (shown_.has_triangles_of_state() || tool_->draws_preview()) return;
  shown_.end_preview();
  show_before(false);
}

ToolAnswer Editor::send_to_gizmo(const InputEvent& event, const Projection& projection) {
  GizmoTool& gizmo = tools_.gizmo;
  const bool was_dragging = gizmo.is_dragging();
  const auto pick_still = [this, &projection](const Eigen::Vector2d& pixel) {
    return pick_beside_roi(projection.ray_through(pixel));
  };
  ToolAnswer answer = gizmo.handle(
      event, {state(), positions(), projection, {}, {}, part_, handle_, gizmo_keys_, pick_still});
  if (gizmo.is_dragging() && !was_dragging) begin_drag();
  // If the drag was given up, the result of the earlier moves is wanted again.
  const bool given_up = was_dragging && !gizmo.is_dragging() && !answer.command;
  if (given_up && needs_settling(state())) {
    shown_.follow_from(dragged_from_);
    session_->prepare(dragged_from_);
  }
  return answer;
}

void Editor::begin_drag() {
  drag_is_of_last_step_ = false;
  shown_.end_preview();
  shown_.show_before(false);
  pointed_at_.clear();
  // The result under way is outdated, and it delays the exact response.
  session_->cancel_settling();
  live_.reset();
  dragged_from_ = shown_.pose();
}

void Editor::click(const Eigen::Vector2d& pixel, const ViewFrame& view) {
  const auto pick = shown_.pick(view, pixel);
  if (!pick) return say_("");
  const auto& handles = state().selection.handles;
  for (std::size_t h = 0; h < handles.size() && shown_.has_triangles_of_state(); ++h) {
    if (std::ranges::binary_search(handles[h].vertices, pick->vertex)) choose({Role::handle, h});
  }
  char text[128];
  std::snprintf(text, sizeof text, "Vertex %u, face %u at (%.5g, %.5g, %.5g)", pick->vertex,
                shown_.topology().triangle_faces[pick->triangle], pick->position.x(),
                pick->position.y(), pick->position.z());
  say_(text);
}

bool Editor::attempt(const std::function<void()>& change) {
  const bool carried_out = session_->is_carrying_out();
  const bool is_done = say_errors(say_, [&] {
    change();
    pointed_at_.clear();
    if (!session_->warning().empty()) say_({session_->warning(), Tone::warning});
    if (carried_out && !session_->is_carrying_out()) {
      say_("The step was cancelled because the surface has changed. Apply it again.");
    }
  });
  if (is_done) say_({"", Tone::error});  // what failed before is done, or no longer wanted
  state_changed();
  return is_done;
}

bool Editor::perform(const Command& command, Joining joining) {
  if (waits() && commits(command)) {
    postpone([this, command, joining] { perform(command, joining); });
    return false;
  }
  sizable_at_.reset();
  hold_pose();
  const std::size_t handles = handle_count();
  const bool moves_on = std::holds_alternative<MoveHandle>(command);
  const bool is_done =
      attempt([&] { session_->perform(command, joining, moves_on ? shown_.pose() : nullptr); });
  const auto is_of_roi = [](const auto* choice) {
    return choice != nullptr && choice->part.role == Role::roi;
  };
  const bool of_roi =
      is_of_roi(std::get_if<Choose>(&command)) || is_of_roi(std::get_if<Paint>(&command));
  if (is_done && of_roi) say_what_was_let_go(handles);
  if (const auto* mirror = std::get_if<SetMirror>(&command); is_done && mirror != nullptr) {
    say_(mirror->plane ? "Mirror on" : "Mirror off");
  }
  return is_done;
}

// A state that waits for its result looks the same however the user came to it.
void Editor::step_through_history(const std::function<void()>& change) {
  if (is_dragging()) return;
  give_up_postponed();
  shown_.follow_from(nullptr);
  say_("");  // the last message belongs to the step that is left
  attempt(change);
}

// Postponed actions were done last, so undo drops them first.
void Editor::undo() {
  if (has_postponed() && !is_dragging()) {
    give_up_postponed();
    return say_("");
  }
  step_through_history([&] { session_->undo(); });
}

void Editor::redo() {
  step_through_history([&] { session_->redo(); });
}

void Editor::go_to(std::size_t steps) {
  step_through_history([&] { session_->go_to(steps); });
}

void Editor::continue_with(History history) {
  step_through_history([&] { session_->continue_with(std::move(history)); });
}

void Editor::settle() {
  session_->prepare();
}

// What is shown, perhaps a preview of the step, stays until the result is ready.
void Editor::carry_out(const Step& step) {
  say_errors(say_, [&] { session_->carry_out(step); });
}

void Editor::replace_step(std::size_t index, const Step& step) {
  say_errors(say_, [&] { session_->replace_step(index, step); });
}

void Editor::carry_along(const std::vector<std::filesystem::path>& files) {
  say_errors(say_, [&] { session_->carry_along(files); });
}

void Editor::new_edit() {
  if (is_dragging()) return;
  if (waits()) return postpone([this] { new_edit(); });
  if (!perform(NewEdit{})) return;
  choose({Role::roi});
  if (has_in_hand(tools_.gizmo)) take(Action::take_disk);
  say_("New edit: select a region.");
}

void Editor::change_part(const PartChange& change) {
  if (const auto command = change(state(), part_)) perform(*command);
}

void Editor::mirror_by_shape() {
  say_errors(say_, [&] {
    const FoundMirror found = find_mirror_plane(*surface_of(state()), "mirror");
    if (!perform(SetMirror{found.plane})) return;
    char text[96];
    std::snprintf(text, sizeof text,
                  "Mirror on. The surface differs from its mirror image by %.2g%% of its size.",
                  100.0 * found.asymmetry);
    say_(text);
  });
}

bool Editor::handles_leave_roi() const {
  const EditSelection& chosen = state().selection;
  return std::ranges::any_of(chosen.handles, [&](const auto& handle) {
    return !subtract(handle.vertices, chosen.roi.vertices).empty();
  });
}

void Editor::enlarge_roi() {
  const EditSelection& selection = state().selection;
  const VertexSet& roi = selection.roi.vertices;
  const auto& rings = surface_of(state())->topology().rings;
  VertexSet wanted;
  if (handles_leave_roi()) {
    for (const ChosenRegion& handle : selection.handles) wanted = unite(wanted, handle.vertices);
    for (int ring = 0; ring < kRingsAroundHandle; ++ring) {
      wanted = with_ring_neighbours(wanted, rings);
    }
  } else {
    wanted = roi;
    for (std::size_t before = 0; before < wanted.size() && 2 * wanted.size() < 3 * roi.size();) {
      before = wanted.size();
      wanted = with_ring_neighbours(wanted, rings);
    }
  }
  perform(EnlargeRoi{subtract(wanted, roi)});
}

void Editor::carry_out(Remedy remedy) {
  EditParameters parameters = state().parameters;
  switch (remedy) {
    case Remedy::enlarge_region:
      return enlarge_roi();
    case Remedy::select_region:
      return begin_choosing({Role::roi});
    case Remedy::raise_iterations:
      if (!parameters.settle) return;
      parameters.settle->max_iterations *= 2;
      perform(SetParameters{parameters});
      return;
    case Remedy::hold_exactly:
      parameters.hard = true;
      perform(SetParameters{parameters});
      return;
    case Remedy::undo:
      return undo();
  }
}

void Editor::take(const ToolRow& row) {
  if (is_dragging()) return;
  tool_ = &row.take(tools_);
  row_ = &row;
  tools_.loop.reset();
  classes_are_old_ = true;  // one of the tools colours the surface by its stiffness
}

bool Editor::take(Action action) {
  const auto row = std::ranges::find(tool_rows(), action, &ToolRow::action);
  if (row == tool_rows().end()) return false;
  take(*row);
  return true;
}

void Editor::lend(SceneTool& tool) {
  if (is_dragging()) return;
  tools_.loop.reset();
  tool_ = &tool;
  row_ = nullptr;
}

void Editor::give_back(const SceneTool& tool) {
  if (!has_in_hand(tool)) return;
  row_ = &tool_rows().front();
  tool_ = &row_->take(tools_);
}

void Editor::choose(const Part& part) {
  if (is_dragging()) return;
  part_ = part;
  tools_.loop.reset();
  if (part.role == Role::handle && part.handle < handle_count()) handle_ = part.handle;
}

void Editor::begin_choosing(const Part& part) {
  choose(part);
  if (!chooses_parts()) take(Action::take_disk);
}

void Editor::go_on() {
  if (part_.role == Role::roi && !state().selection.roi.vertices.empty()) {
    choose({Role::handle, 0});
    if (handle_count() > 0) take(Action::take_move);
  } else if (part_.role == Role::handle && part_.handle < handle_count()) {
    handle_ = part_.handle;
    take(Action::take_move);
  }
}

void Editor::choose_all() {
  if (is_dragging()) return;
  if (waits()) return postpone([this] { choose_all(); });
  if (!chooses_parts()) choose({Role::roi});
  change_part(viewer::choose_all);
  if (part_.role != Role::roi) return;
  go_on();
  if (handle_count() == 0) begin_choosing(part_);
}

std::vector<Index> Editor::selected() const {
  const EditSelection& selection = state().selection;
  const VertexSet& vertices = vertices_of(selection, part_);
  return vertices.empty() ? selection.roi.vertices : vertices;
}

}  // namespace lapwing::viewer
