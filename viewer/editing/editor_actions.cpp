#include "editing/editor_actions.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "tools/selection_edits.h"

namespace lapwing::viewer {
namespace {

using Role = Part::Role;

// Leaves room for the surface between handle and belt.
constexpr int kRingsAroundHandle = 6;

// Returns the command that removes the handle `part`, or nullopt if `part` is not a handle.
std::optional<Command> remove_handle(const AppState& state, const Part& part) {
  return part.role == Role::handle ? clear(state, part) : std::nullopt;
}

struct PartAction {
  Action action;
  std::optional<Command> (*change)(const AppState&, const Part&);
};
constexpr std::array kPartActions{PartAction{Action::clear, clear}, PartAction{Action::grow, grow},
                                  PartAction{Action::shrink, shrink},
                                  PartAction{Action::invert, invert},
                                  PartAction{Action::remove_handle, remove_handle}};

// Actions whose order matters, because they determine what the user chooses next.
constexpr std::array kChoices{Action::choose_roi, Action::choose_handle, Action::add_handle,
                              Action::choose_belt, Action::go_on};

void take_next_gizmo_axes(Editor& editor) {
  // Indexed by GizmoAxes.
  constexpr std::array kSaid{"Orientation: World", "Orientation: Local", "Orientation: Normal"};
  GizmoTool& gizmo = editor.tool().tools().gizmo;
  GizmoChoices choices = gizmo.choices();
  const std::size_t next = (static_cast<std::size_t>(choices.axes) + 1) % kSaid.size();
  choices.axes = static_cast<GizmoAxes>(next);
  gizmo.set_choices(choices);
  editor.say(kSaid[next]);
}

void toggle_sticking(Editor& editor) {
  GizmoTool& gizmo = editor.tool().tools().gizmo;
  GizmoChoices choices = gizmo.choices();
  choices.sticks_to_surface = !choices.sticks_to_surface;
  gizmo.set_choices(choices);
  editor.say(choices.sticks_to_surface ? "Snap to surface on" : "Snap to surface off");
}

}  // namespace

void new_edit(Editor& editor) {
  ActiveTool& active = editor.tool();
  if (active.is_dragging()) return;
  if (editor.actions().waits()) {
    return editor.actions().postpone([&editor] { new_edit(editor); });
  }
  if (!editor.actions().perform(NewEdit{})) return;
  active.choose({Role::roi});
  if (active.is(active.tools().gizmo)) active.take(Action::take_disk);
  editor.say("New edit: select a region.");
}

void change_part(Editor& editor, const PartChange& change) {
  const auto command = change(editor.state(), editor.tool().part());
  if (command) editor.actions().perform(*command);
}

void choose_all(Editor& editor) {
  ActiveTool& active = editor.tool();
  if (active.is_dragging()) return;
  if (editor.actions().waits()) {
    return editor.actions().postpone([&editor] { choose_all(editor); });
  }
  if (!active.chooses_parts()) active.choose({Role::roi});
  change_part(editor, [](const auto& state, const Part& part) { return choose_all(state, part); });
  if (active.part().role != Role::roi) return;
  active.go_on();
  if (editor.state().selection.handles.empty()) active.begin_choosing(active.part());
}

void mirror_by_shape(Editor& editor) {
  const auto say = [&editor](Message message) { editor.say(std::move(message)); };
  say_errors(say, [&] {
    const FoundMirror found = find_mirror_plane(*surface_of(editor.state()), "mirror");
    if (!editor.actions().perform(SetMirror{found.plane})) return;
    char text[96];
    std::snprintf(text, sizeof text,
                  "Mirror on. The surface differs from its mirror image by %.2g%% of its size.",
                  100.0 * found.asymmetry);
    say(text);
  });
}

bool handles_leave_roi(const EditSelection& selection) {
  return std::ranges::any_of(selection.handles, [&](const auto& handle) {
    return !subtract(handle.vertices, selection.roi.vertices).empty();
  });
}

void enlarge_roi(Editor& editor) {
  const EditSelection& selection = editor.state().selection;
  const VertexSet& roi = selection.roi.vertices;
  const auto& rings = surface_of(editor.state())->topology().rings;
  VertexSet wanted;
  if (handles_leave_roi(selection)) {
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
  editor.actions().perform(EnlargeRoi{subtract(wanted, roi)});
}

void carry_out(Editor& editor, Remedy remedy) {
  ActionQueue& actions = editor.actions();
  EditParameters parameters = editor.state().parameters;
  switch (remedy) {
    case Remedy::enlarge_region:
      return enlarge_roi(editor);
    case Remedy::select_region:
      return editor.tool().begin_choosing({Role::roi});
    case Remedy::raise_iterations:
      if (!parameters.settle) return;
      parameters.settle->max_iterations *= 2;
      actions.perform(SetParameters{parameters});
      return;
    case Remedy::hold_exactly:
      parameters.hard = true;
      actions.perform(SetParameters{parameters});
      return;
    case Remedy::undo:
      return actions.undo();
  }
}

bool perform_on(Editor& editor, Action action) {
  const bool chooses =
      std::ranges::find(kChoices, action) != kChoices.end() ||
      std::ranges::find(tool_rows(), action, &ToolRow::action) != tool_rows().end();
  if (chooses && editor.actions().has_postponed()) {
    editor.actions().postpone([&editor, action] { perform_on(editor, action); });
    return true;
  }
  ActiveTool& active = editor.tool();
  const std::size_t handles = editor.state().selection.handles.size();
  if (active.take(action)) return true;
  const auto of_part = std::ranges::find(kPartActions, action, &PartAction::action);
  if (of_part != kPartActions.end()) {
    change_part(editor, of_part->change);
    return true;
  }
  switch (action) {
    case Action::go_on:
      active.go_on();
      return true;
    case Action::select_all:
      choose_all(editor);
      return true;
    case Action::new_edit:
      new_edit(editor);
      return true;
    case Action::undo:
      editor.actions().undo();
      return true;
    case Action::redo:
      editor.actions().redo();
      return true;
    case Action::choose_roi:
      active.begin_choosing({Role::roi});
      return true;
    case Action::choose_handle:
      active.begin_choosing({Role::handle, active.handle()});
      return true;
    case Action::add_handle:
      active.begin_choosing({Role::handle, handles});
      return true;
    case Action::choose_belt:
      active.begin_choosing({Role::belt});
      return true;
    case Action::toggle_mirror:
      if (editor.state().selection.mirror) {
        editor.actions().perform(SetMirror{});
      } else {
        mirror_by_shape(editor);
      }
      return true;
    case Action::next_gizmo_axes:
      take_next_gizmo_axes(editor);
      return true;
    case Action::toggle_sticking:
      toggle_sticking(editor);
      return true;
    case Action::toggle_before:
      editor.view().show_before(!editor.view().shown().shows_before());
      return true;
    default:
      return false;
  }
}

bool perform_on(DetailTransferTool& desk, Editor& editor, Action action) {
  using Picking = DetailTransferTool::Picking;
  switch (action) {
    case Action::begin_coat:
      desk.begin(editor, LayerDraft::Operation::coat);
      return true;
    case Action::begin_mix:
      desk.begin(editor, LayerDraft::Operation::mix);
      return true;
    case Action::other_source:
      if (desk.is_open()) desk.show((desk.current() + 1) % desk.draft().source_count());
      return true;
    case Action::pick_pairs:
      if (!desk.is_open()) return true;
      desk.pick(desk.picking() == Picking::none ? Picking::inside : Picking::none, editor);
      return true;
    case Action::apply_step:
      if (desk.is_open()) desk.apply(editor);
      return true;
    default:
      return false;
  }
}

bool perform_on(WrapTool& wrap, Editor& editor, Action action) {
  if (!wrap.is_open()) return false;
  switch (action) {
    case Action::undo:
      return wrap.undo();
    case Action::redo:
      return wrap.redo();
    case Action::pick_pairs:
      wrap.pick(!wrap.picks(), editor);
      return true;
    case Action::apply_step:
      wrap.apply(editor);
      return true;
    default:
      return false;
  }
}

}  // namespace lapwing::viewer
