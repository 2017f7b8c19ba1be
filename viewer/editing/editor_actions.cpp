#include "editing/editor_actions.h"

#include <algorithm>
#include <array>

namespace lapwing::viewer {

namespace {

using Role = Part::Role;

struct PlainAction {
  Action action;
  void (Editor::*perform)();
};
constexpr std::array kPlainActions{PlainAction{Action::go_on, &Editor::go_on},
                                   PlainAction{Action::new_edit, &Editor::new_edit},
                                   PlainAction{Action::select_all, &Editor::select_all},
                                   PlainAction{Action::clear, &Editor::clear},
                                   PlainAction{Action::grow, &Editor::grow},
                                   PlainAction{Action::shrink, &Editor::shrink},
                                   PlainAction{Action::invert, &Editor::invert},
                                   PlainAction{Action::remove_handle, &Editor::remove_handle},
                                   PlainAction{Action::undo, &Editor::undo},
                                   PlainAction{Action::redo, &Editor::redo}};

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
  const auto choose = [&](const Part& part) {
    editor.choose(part);
    if (editor.has_in_hand(editor.gizmo_tool())) editor.take(Action::take_disk);
  };
  if (editor.take(action)) return true;
  const auto plain = std::ranges::find(kPlainActions, action, &PlainAction::action);
  if (plain != kPlainActions.end()) {
    (editor.*plain->perform)();
    return true;
  }
  switch (action) {
    case Action::choose_roi:
      choose({Role::roi});
      return true;
    case Action::choose_handle:
      choose({Role::handle, editor.handle()});
      return true;
    case Action::add_handle:
      choose({Role::handle, handles});
      return true;
    case Action::choose_belt:
      choose({Role::belt});
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
