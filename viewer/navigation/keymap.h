#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/input.h"

namespace lapwing::viewer {

/// The camera motion of a mouse drag.
enum class Motion { orbit, pan, zoom };

/// The actions that keys trigger.
enum class Action {
  frame_all,
  frame_selection,
  view_front,
  view_back,
  view_right,
  view_left,
  view_top,
  view_bottom,
  view_three_quarter,
  toggle_projection,
  orbit_left,
  orbit_right,
  orbit_up,
  orbit_down,
  zoom_in,
  zoom_out,
  toggle_wireframe,
  toggle_xray,
  toggle_flat,
  toggle_panels,
  toggle_controls,
  choose_roi,
  choose_handle,
  add_handle,
  choose_belt,
  take_grab,
  take_move,
  take_disk,
  take_loop,
  take_brush,
  take_lasso,
  take_box,
  take_pin,
  take_stiffness,
  take_ruler,
  next_gizmo_axes,
  toggle_sticking,
  go_on,
  new_edit,
  select_all,
  clear,
  grow,
  shrink,
  invert,
  remove_handle,
  take_part,
  take_up_part,
  toggle_before,
  toggle_slider,
  toggle_mirror,
  begin_coat,
  begin_mix,
  begin_wrap,
  open_source,
  other_source,
  pick_pairs,
  apply_step,
  undo,
  redo,
  open,
  save,
  save_as,
  save_recipe,
  replay_recipe,
  save_picture,
  save_turntable,
  carry_file,
  save_carried,
  quit,
};

struct DragBinding {
  MouseButton button = MouseButton::none;
  Modifiers modifiers;
  Motion motion = Motion::orbit;
};

/// A key that is pressed with exactly these modifiers. '?' means the typed character, because its
/// key depends on the keyboard layout.
struct KeyBinding {
  int key = 0;
  Modifiers modifiers;
  Action action = Action::frame_all;
  std::string_view words = "";  ///< description; if empty, that of the previous binding
};

/// The mouse bindings of one program.
struct Keymap {
  std::string_view name;
  std::span<const DragBinding> drags;
};

/// Returns the keymaps of Blender, Maya and MeshLab. They differ only in the mouse controls of the
/// camera; `key_bindings` is the same for all of them.
std::span<const Keymap> keymaps();
/// Returns the keymap with this name, or the first one if the name is unknown. Preferences of
/// another version may contain an unknown name.
const Keymap& keymap_named(std::string_view name);
std::span<const KeyBinding> key_bindings();

/// Returns the motion for a drag with this button and these modifiers, if any.
std::optional<Motion> motion_of(const Keymap& keymap, MouseButton button,
                                const Modifiers& modifiers);
/// Returns the action of a key or text event, if any.
std::optional<Action> action_of(const InputEvent& event);

/// One line of the list of controls: "Shift + middle drag", "move the view sideways".
struct ControlLine {
  std::string how;
  std::string what;
};
/// Return the mouse controls of `keymap`, and the key controls.
std::vector<ControlLine> mouse_controls(const Keymap& keymap);
std::vector<ControlLine> key_controls();
/// Returns the key of `action` in the notation of menus, such as "Ctrl+Shift+Z", and its
/// description. Both are empty if the action has no key.
ControlLine control_of(Action action);
/// Returns the controls of all keymaps as a table in Markdown.
std::string controls_table();

}  // namespace lapwing::viewer
