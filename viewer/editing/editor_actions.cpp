#include "editing/editor_actions.h"

#include <algorithm>
#include <array>

#include "tools/selection_edits.h"

namespace lapwing::viewer {
namespace {

using Role = Part::Role;

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

}  // namespace

bool perform_on(Editor& editor, Action action) {
  const bool chooses =
      std::ranges::find(kChoices, action) != kChoices.end() ||
      std::ranges::find(tool_rows(), action, &ToolRow::action) != tool_rows().end();
  if (chooses && editor.has_postponed()) {
    editor.postpone([&editor, action] { perform_on(editor, action); });
    return true;
  }
  const std::size_t handles = editor.state().selection.handles.size();
  if (editor.take(action)) return true;
  const auto of_part = std::ranges::find(kPartActions, action, &PartAction::action);
  if (of_part != kPartActions.end()) {
    editor.change_part(of_part->change);
    return true;
  }
  switch (action) {
    case Action::go_on:
      editor.go_on();
      return true;
    case Action::select_all:
      editor.choose_all();
      return true;
    case Action::new_edit:
      editor.new_edit();
      return true;
    case Action::undo:
      editor.undo();
      return true;
    case Action::redo:
      editor.redo();
      return true;
    case Action::choose_roi:
      editor.begin_choosing({Role::roi});
      return true;
    case Action::choose_handle:
      editor.begin_choosing({Role::handle, editor.handle()});
      return true;
    case Action::add_handle:
      editor.begin_choosing({Role::handle, handles});
      return true;
    case Action::choose_belt:
      editor.begin_choosing({Role::belt});
      return true;
    case Action::toggle_mirror:
      if (editor.state().selection.mirror) {
        editor.perform(SetMirror{});
      } else {
        editor.mirror_by_shape();
      }
      return true;
    case Action::next_gizmo_axes:
      editor.take_next_gizmo_axes();
      return true;
    case Action::toggle_sticking:
      editor.toggle_sticking();
      return true;
    case Action::toggle_before:
      editor.show_before(!editor.shown().shows_before());
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

}  // namespace lapwing::viewer
