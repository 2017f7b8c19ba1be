#include "navigation/keymap.h"

#include <utility>

namespace lapwing::viewer {
namespace {

constexpr Modifiers kPlain{};
constexpr Modifiers kShift{.shift = true};
constexpr Modifiers kControl{.control = true};
constexpr Modifiers kAlt{.alt = true};
constexpr Modifiers kControlShift{.shift = true, .control = true};

// Where no tool takes it, the left button orbits in every keymap: not every mouse has three.
constexpr std::array kBlenderDrags{DragBinding{MouseButton::middle, kPlain, Motion::orbit},
                                   DragBinding{MouseButton::middle, kShift, Motion::pan},
                                   DragBinding{MouseButton::middle, kControl, Motion::zoom},
                                   DragBinding{MouseButton::left, kAlt, Motion::orbit},
                                   DragBinding{MouseButton::left, kPlain, Motion::orbit},
                                   DragBinding{MouseButton::left, kShift, Motion::pan}};
constexpr std::array kMayaDrags{DragBinding{MouseButton::left, kAlt, Motion::orbit},
                                DragBinding{MouseButton::middle, kAlt, Motion::pan},
                                DragBinding{MouseButton::right, kAlt, Motion::zoom},
                                DragBinding{MouseButton::left, kPlain, Motion::orbit}};
constexpr std::array kMeshLabDrags{DragBinding{MouseButton::left, kPlain, Motion::orbit},
                                   DragBinding{MouseButton::middle, kPlain, Motion::pan},
                                   DragBinding{MouseButton::left, kControl, Motion::pan},
                                   DragBinding{MouseButton::left, kShift, Motion::zoom}};

constexpr std::array kKeymaps{Keymap{"Blender", kBlenderDrags}, Keymap{"Maya", kMayaDrags},
                              Keymap{"MeshLab", kMeshLabDrags}};

constexpr std::array kKeyBindings{KeyBinding{kHome, kPlain, Action::frame_all},
                                  KeyBinding{'F', kPlain, Action::frame_selection},
                                  KeyBinding{'.', kPlain, Action::frame_selection},
                                  KeyBinding{'1', kPlain, Action::view_front},
                                  KeyBinding{'1', kControl, Action::view_back},
                                  KeyBinding{'3', kPlain, Action::view_right},
                                  KeyBinding{'3', kControl, Action::view_left},
                                  KeyBinding{'7', kPlain, Action::view_top},
                                  KeyBinding{'7', kControl, Action::view_bottom},
                                  KeyBinding{'0', kPlain, Action::view_three_quarter},
                                  KeyBinding{'5', kPlain, Action::toggle_projection},
                                  KeyBinding{kLeft, kPlain, Action::orbit_left},
                                  KeyBinding{kRight, kPlain, Action::orbit_right},
                                  KeyBinding{kUp, kPlain, Action::orbit_up},
                                  KeyBinding{kDown, kPlain, Action::orbit_down},
                                  KeyBinding{'=', kPlain, Action::zoom_in},
                                  KeyBinding{'-', kPlain, Action::zoom_out},
                                  KeyBinding{'Z', kShift, Action::toggle_wireframe},
                                  KeyBinding{'L', kShift, Action::toggle_flat},
                                  KeyBinding{kTab, kPlain, Action::toggle_panels},
                                  KeyBinding{'?', kPlain, Action::toggle_controls},
                                  KeyBinding{kF1, kPlain, Action::toggle_controls},
                                  KeyBinding{'I', kPlain, Action::choose_roi},
                                  KeyBinding{'H', kPlain, Action::choose_handle},
                                  KeyBinding{'H', kShift, Action::add_handle},
                                  KeyBinding{'T', kPlain, Action::choose_belt},
                                  KeyBinding{'D', kPlain, Action::take_disk},
                                  KeyBinding{'O', kPlain, Action::take_loop},
                                  KeyBinding{'P', kPlain, Action::take_brush},
                                  KeyBinding{'L', kPlain, Action::take_lasso},
                                  KeyBinding{'B', kPlain, Action::take_box},
                                  KeyBinding{'M', kPlain, Action::take_move},
                                  KeyBinding{kEscape, kPlain, Action::take_move},
                                  KeyBinding{kEnter, kPlain, Action::go_on},
                                  KeyBinding{'=', kControl, Action::grow},
                                  KeyBinding{'-', kControl, Action::shrink},
                                  KeyBinding{'I', kControl, Action::invert},
                                  KeyBinding{kDelete, kPlain, Action::remove_handle},
                                  KeyBinding{'N', kPlain, Action::take_part},
                                  KeyBinding{'N', kShift, Action::take_up_part},
                                  KeyBinding{'C', kPlain, Action::toggle_before},
                                  KeyBinding{'K', kControl, Action::begin_coat},
                                  KeyBinding{'M', kControl, Action::begin_mix},
                                  KeyBinding{'K', kControlShift, Action::open_source},
                                  KeyBinding{'K', kShift, Action::other_source},
                                  KeyBinding{'K', kPlain, Action::pick_pairs},
                                  KeyBinding{kEnter, kControl, Action::apply_step},
                                  KeyBinding{'Z', kControl, Action::undo},
                                  KeyBinding{'Z', kControlShift, Action::redo},
                                  KeyBinding{'Y', kControl, Action::redo},
                                  KeyBinding{'O', kControl, Action::open},
                                  KeyBinding{'S', kControl, Action::save},
                                  KeyBinding{'S', kControlShift, Action::save_as},
                                  KeyBinding{'E', kControl, Action::save_recipe},
                                  KeyBinding{'R', kControl, Action::replay_recipe},
                                  KeyBinding{'P', kControl, Action::save_picture},
                                  KeyBinding{'Q', kControl, Action::quit}};

std::string_view words(Motion motion) {
  switch (motion) {
    case Motion::orbit:
      return "turn the view";
    case Motion::pan:
      return "move the view sideways";
    case Motion::zoom:
      return "zoom";
  }
  return {};
}

std::string_view words(Action action) {
  switch (action) {
    case Action::frame_all:
      return "show all of the mesh";
    case Action::frame_selection:
      return "show the selection, or all";
    case Action::view_front:
      return "from the front";
    case Action::view_back:
      return "from the back";
    case Action::view_right:
      return "from the right";
    case Action::view_left:
      return "from the left";
    case Action::view_top:
      return "from above";
    case Action::view_bottom:
      return "from below";
    case Action::view_three_quarter:
      return "from the front, a little aside and above";
    case Action::toggle_projection:
      return "perspective or parallel";
    case Action::orbit_left:
      return "turn the view to the left";
    case Action::orbit_right:
      return "turn the view to the right";
    case Action::orbit_up:
      return "turn the view upwards";
    case Action::orbit_down:
      return "turn the view downwards";
    case Action::zoom_in:
      return "zoom in";
    case Action::zoom_out:
      return "zoom out";
    case Action::toggle_wireframe:
      return "edges of the polygons";
    case Action::toggle_flat:
      return "smooth or flat";
    case Action::toggle_panels:
      return "hide or show the panels";
    case Action::toggle_controls:
      return "this list";
    case Action::choose_roi:
      return "choose the region to edit (ROI)";
    case Action::choose_handle:
      return "choose the handle";
    case Action::add_handle:
      return "choose one more handle";
    case Action::choose_belt:
      return "choose the belt by hand";
    case Action::take_move:
      return "move: the gizmo, and the left button turns the view";
    case Action::take_disk:
      return "choose by a disk: drag from its middle to its rim, or click and scroll";
    case Action::take_loop:
      return "choose by a loop: click around, close it, click the side to keep";
    case Action::take_brush:
      return "choose by a brush: [ and ] size it, Ctrl erases";
    case Action::take_lasso:
      return "choose by a lasso: Ctrl erases";
    case Action::take_box:
      return "choose by a box: Ctrl erases";
    case Action::go_on:
      return "go on from the ROI to the handle, and from there to moving it";
    case Action::grow:
      return "grow what is chosen by a ring";
    case Action::shrink:
      return "shrink what is chosen by a ring";
    case Action::invert:
      return "choose what is not chosen";
    case Action::remove_handle:
      return "remove the handle";
    case Action::take_part:
      return "take a part of the folder in hand, then the next one";
    case Action::take_up_part:
      return "take the transplant made last up again";
    case Action::toggle_before:
      return "compare with the mesh as it was opened";
    case Action::begin_coat:
      return "coat the ROI with the detail of another patch";
    case Action::begin_mix:
      return "mix the details of two patches on the ROI";
    case Action::open_source:
      return "take a coat or mix from another mesh";
    case Action::other_source:
      return "the other source of a mix";
    case Action::pick_pairs:
      return "pick corresponding points for a coat or mix, or no longer";
    case Action::apply_step:
      return "apply the coat or mix";
    case Action::undo:
      return "undo";
    case Action::redo:
      return "redo";
    case Action::open:
      return "open";
    case Action::save:
      return "save the mesh";
    case Action::save_as:
      return "save the mesh as another file";
    case Action::save_recipe:
      return "save the steps as a recipe";
    case Action::replay_recipe:
      return "replay a recipe on this mesh";
    case Action::save_picture:
      return "save a picture";
    case Action::quit:
      return "quit";
  }
  return {};
}

std::string_view words(MouseButton button) {
  switch (button) {
    case MouseButton::left:
      return "left";
    case MouseButton::middle:
      return "middle";
    case MouseButton::right:
      return "right";
    case MouseButton::none:
      break;
  }
  return {};
}

std::string words(const Modifiers& modifiers) {
  std::string text;
  if (modifiers.control) text += "Ctrl + ";
  if (modifiers.alt) text += "Alt + ";
  if (modifiers.shift) text += "Shift + ";
  return text;
}

std::string key_name(int key) {
  switch (key) {
    case kEscape:
      return "Escape";
    case kEnter:
      return "Enter";
    case kTab:
      return "Tab";
    case kBackspace:
      return "Backspace";
    case kDelete:
      return "Delete";
    case kHome:
      return "Home";
    case kEnd:
      return "End";
    case kLeft:
      return "Left";
    case kRight:
      return "Right";
    case kUp:
      return "Up";
    case kDown:
      return "Down";
    case kF1:
      return "F1";
    default:
      return std::string(1, static_cast<char>(key));
  }
}

// GizmoTool's keys.
std::vector<ControlLine> gizmo_controls() {
  return {{"G, R, S", "move, turn, scale the handle with the mouse (Maya: R scales, E turns)"},
          {"X, Y, Z meanwhile", "along or about that axis; with Shift, in the plane across it"},
          {"0 to 9, . and - meanwhile", "by that number"},
          {"Ctrl meanwhile", "in steps"},
          {"Enter or click, Escape or right click", "done, or give it up"},
          {"W, E, Q", "the gizmo moves, turns, scales the handle"}};
}

// PlaceTool's.
std::vector<ControlLine> part_controls() {
  return {{"wheel, [ and ], with a part in hand", "size it; Shift + wheel turns it"},
          {"G, Enter, Escape, when it is set down", "take it up again, apply it, give it up"}};
}

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

}  // namespace

std::span<const Keymap> keymaps() {
  return kKeymaps;
}
std::span<const KeyBinding> key_bindings() {
  return kKeyBindings;
}

std::optional<Motion> motion_of(const Keymap& keymap, MouseButton button,
                                const Modifiers& modifiers) {
  for (const DragBinding& binding : keymap.drags) {
    if (binding.button == button && binding.modifiers == modifiers) return binding.motion;
  }
  return {};
}

std::optional<Action> action_of(const InputEvent& event) {
  const bool typed = event.kind == InputKind::text;
  if (!typed && event.kind != InputKind::key) return {};
  for (const KeyBinding& binding : kKeyBindings) {
    if (typed != (binding.key == '?')) continue;
    if (typed ? event.text == U'?'
              : binding.key == event.key && binding.modifiers == event.modifiers) {
      return binding.action;
    }
  }
  return {};
}

std::vector<ControlLine> mouse_controls(const Keymap& keymap) {
  std::vector<ControlLine> lines;
  for (const DragBinding& binding : keymap.drags) {
    lines.push_back({words(binding.modifiers) + std::string(words(binding.button)) + " drag",
                     std::string(words(binding.motion))});
  }
  lines.push_back({"wheel", "zoom to what is under the cursor"});
  lines.push_back({"left click", "say what is there"});
  lines.push_back({"drop a file", "open it"});
  return lines;
}

std::vector<ControlLine> key_controls() {
  std::vector<ControlLine> lines = gizmo_controls();
  for (const KeyBinding& binding : kKeyBindings) {
    std::string how = words(binding.modifiers) + key_name(binding.key);
    const std::string_view what = words(binding.action);
    if (!lines.empty() && lines.back().what == what) {
      lines.back().how += " or " + how;
    } else {
      lines.push_back({std::move(how), std::string(what)});
    }
  }
  for (ControlLine& line : part_controls()) lines.push_back(std::move(line));
  return lines;
}

std::string controls_table() {
  std::string text = row({"keymap", "do", "to"}) + "|---|---|---|\n";
  for (const Keymap& keymap : kKeymaps) {
    for (const ControlLine& line : mouse_controls(keymap)) {
      text += row({std::string(keymap.name), line.how, line.what});
    }
  }
  for (const ControlLine& line : key_controls()) text += row({"all", line.how, line.what});
  return text;
}

}  // namespace lapwing::viewer
