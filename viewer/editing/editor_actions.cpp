#include "editing/editor_actions.h"

namespace lapwing::viewer {

using Role = Part::Role;

bool perform_on(Editor& editor, Action action) {
  const std::size_t handles = editor.state().selection.handles.size();
  const auto choose = [&](const Part& part) {
    editor.choose(part);
    if (editor.has_in_hand(editor.gizmo_tool())) editor.take(Action::take_disk);
  };
  if (editor.take(action)) return true;
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
    case Action::go_on:
      editor.go_on();
      return true;
    case Action::grow:
      editor.grow();
      return true;
    case Action::shrink:
      editor.shrink();
      return true;
    case Action::invert:
      editor.invert();
      return true;
    case Action::remove_handle:
      editor.remove_handle();
      return true;
    case Action::toggle_before:
      editor.show_before(!editor.shown().shows_before());
      return true;
    case Action::undo:
      editor.undo();
      return true;
    case Action::redo:
      editor.redo();
      return true;
    default:
      return false;
  }
}

bool perform_on(LayerDesk& desk, Editor& editor, Action action) {
  using Picking = LayerDesk::Picking;
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
