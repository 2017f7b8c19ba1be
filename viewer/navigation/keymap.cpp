#include "navigation/keymap.h"

#include <utility>

namespace lapwing::viewer {
namespace {

constexpr Modifiers kPlain{};
constexpr Modifiers kShift{.shift = true};
constexpr Modifiers kControl{.control = true};
constexpr Modifiers kAlt{.alt = true};
constexpr Modifiers kControlShift{.shift = true, .control = true};

// Unless a tool uses the left button, it orbits in every keymap, because some mice have no middle
// button.
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

// The key bindings, in the order of the list of controls. Further keys for the same action follow
// without words.
constexpr auto kKeyBindings = std::to_array<KeyBinding>(
    {{kHome, kPlain, Action::frame_all, "show all of the mesh"},
     {'F', kPlain, Action::frame_selection, "show the selection, or all"},
     {'.', kPlain, Action::frame_selection},
     {'1', kPlain, Action::view_front, "from the front"},
     {'1', kControl, Action::view_back, "from the back"},
     {'3', kPlain, Action::view_right, "from the right"},
     {'3', kControl, Action::view_left, "from the left"},
     {'7', kPlain, Action::view_top, "from above"},
     {'7', kControl, Action::view_bottom, "from below"},
     {'0', kPlain, Action::view_three_quarter, "from the front, a little aside and above"},
     {'5', kPlain, Action::toggle_projection, "perspective or parallel"},
     {kLeft, kPlain, Action::orbit_left, "turn the view to the left"},
     {kRight, kPlain, Action::orbit_right, "turn the view to the right"},
     {kUp, kPlain, Action::orbit_up, "turn the view upwards"},
     {kDown, kPlain, Action::orbit_down, "turn the view downwards"},
     {'=', kPlain, Action::zoom_in, "zoom in"},
     {'-', kPlain, Action::zoom_out, "zoom out"},
     {'Z', kShift, Action::toggle_wireframe, "edges of the polygons"},
     {'L', kShift, Action::toggle_flat, "smooth or flat"},
     {kTab, kPlain, Action::toggle_panels, "hide or show the panels"},
     {'?', kPlain, Action::toggle_controls, "this list"},
     {kF1, kPlain, Action::toggle_controls},
     {'I', kPlain, Action::choose_roi, "choose the region to edit (ROI)"},
     {'H', kPlain, Action::choose_handle, "choose the handle"},
     {'H', kShift, Action::add_handle, "choose one more handle"},
     {'T', kPlain, Action::choose_belt, "choose the belt by hand"},
     {'G', kShift, Action::take_grab,
      "grab: press on the surface and pull; with Shift a smaller part, with Ctrl a larger one; [ "
      "and "
      "] size the circle"},
     {'D', kPlain, Action::take_disk,
      "choose by a disk: drag from its middle to its rim, or click; [ and ], or a dot of its rim, "
      "size it"},
     {'O', kPlain, Action::take_loop,
      "choose by a loop: click around, close it, click the side to keep"},
     {'P', kPlain, Action::take_brush, "choose by a brush: [ and ] size it, Ctrl erases"},
     {'L', kPlain, Action::take_lasso, "choose by a lasso: Ctrl erases"},
     {'B', kPlain, Action::take_box, "choose by a box: Ctrl erases"},
     {'V', kPlain, Action::take_pin,
      "pin single vertices and drag them; with Shift only pin or choose them"},
     {'U', kPlain, Action::take_ruler,
      "measure between two points, straight and along the surface; Escape removes it"},
     {'M', kPlain, Action::take_move, "move: the gizmo, and the left button turns the view"},
     {kEscape, kPlain, Action::take_move},
     {',', kPlain, Action::next_gizmo_axes,
      "the gizmo's axes: the world's, the handle's own, along the normal"},
     {kTab, kShift, Action::toggle_sticking,
      "a handle that is moved sticks to the surface beside the ROI, or no longer"},
     {kEnter, kPlain, Action::go_on,
      "go on from the ROI to the handle, and from there to moving it"},
     {'N', kControl, Action::new_edit, "begin a new edit: what was done stays, nothing is chosen"},
     {'A', kControl, Action::select_all, "choose all"},
     {'A', kControlShift, Action::clear, "choose nothing"},
     {'=', kControl, Action::grow, "grow what is chosen by a ring"},
     {'-', kControl, Action::shrink, "shrink what is chosen by a ring"},
     {'I', kControl, Action::invert, "choose what is not chosen"},
     {kDelete, kPlain, Action::remove_handle, "remove the handle"},
     {'N', kPlain, Action::take_part, "take a part of the folder in hand, then the next one"},
     {'N', kShift, Action::take_up_part, "take the transplant made last up again"},
     {'C', kPlain, Action::toggle_before, "compare with the mesh as it was opened"},
     {'K', kControl, Action::begin_coat, "coat the ROI with the detail of another patch"},
     {'M', kShift, Action::toggle_mirror, "mirror in the plane that the shape has, or no longer"},
     {'M', kControl, Action::begin_mix, "mix the details of two patches on the ROI"},
     {'K', kControlShift, Action::open_source, "take a coat or mix from another mesh"},
     {'K', kShift, Action::other_source, "the other source of a mix"},
     {'K', kPlain, Action::pick_pairs, "pick corresponding points for a coat or mix, or no longer"},
     {kEnter, kControl, Action::apply_step, "apply the coat or mix"},
     {'Z', kControl, Action::undo, "undo"},
     {'Z', kControlShift, Action::redo, "redo"},
     {'Y', kControl, Action::redo},
     {'O', kControl, Action::open, "open"},
     {'S', kControl, Action::save, "save the mesh; the first time it asks where"},
     {'S', kControlShift, Action::save_as, "save the mesh as another file"},
     {'E', kControl, Action::save_recipe, "save the steps as a recipe"},
     {'R', kControl, Action::replay_recipe, "replay a recipe on this mesh"},
     {'P', kControl, Action::save_picture, "save a picture"},
     {'P', kControlShift, Action::save_turntable,
      "save pictures from all around, or a video of them"},
     {'Q', kControl, Action::quit, "quit"}});

// The descriptions of the motions, indexed by Motion.
constexpr std::array<std::string_view, 3> kMotions{"turn the view", "move the view sideways",
                                                   "zoom"};

std::string name_of(MouseButton button) {
  return button == MouseButton::left ? "left" : button == MouseButton::middle ? "middle" : "right";
}

std::string words(const Modifiers& modifiers) {
  std::string text;
  if (modifiers.control) text += "Ctrl + ";
  if (modifiers.alt) text += "Alt + ";
  if (modifiers.shift) text += "Shift + ";
  return text;
}

// The names of special keys, indexed by `key - kEscape`.
constexpr std::array<std::string_view, 12> kKeyNames{"Escape", "Enter", "Tab",  "Backspace",
                                                     "Delete", "Home",  "End",  "Left",
                                                     "Right",  "Up",    "Down", "F1"};

std::string key_name(int key) {
  if (key < kEscape) return std::string(1, static_cast<char>(key));
  return std::string(kKeyNames[static_cast<std::size_t>(key - kEscape)]);
}

// Returns the keys of GizmoTool.
std::vector<ControlLine> gizmo_controls() {
  return {{"left drag on a handle", "pull it: it goes along and turns as the surface wants"},
          {"G, R, S", "move, turn, scale the handle with the mouse (Maya: R scales, E turns)"},
          {"X, Y, Z meanwhile",
           "along or about that axis of the gizmo, again: the handle's own or the world's; with "
           "Shift, in the plane across it"},
          {"0 to 9, . and - meanwhile", "by that number"},
          {"Ctrl meanwhile", "in steps"},
          {"Enter or click, Escape or right click", "done, or give it up"},
          {"W, E, Q", "the gizmo moves, turns, scales the handle"}};
}

// Returns the keys of PlaceTool.
std::vector<ControlLine> part_controls() {
  return {{"Ctrl + wheel, [ and ], with a part in hand", "size it; Shift + wheel turns it"},
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
    lines.push_back({words(binding.modifiers) + name_of(binding.button) + " drag",
                     std::string(kMotions[static_cast<std::size_t>(binding.motion)])});
  }
  lines.push_back({"wheel", "zoom to what is under the cursor"});
  lines.push_back({words(kSizes) + "wheel", "size the disk chosen last, or the brush"});
  lines.push_back({"left click", "say what is there"});
  lines.push_back({"drop a file", "open it"});
  return lines;
}

std::vector<ControlLine> key_controls() {
  std::vector<ControlLine> lines = gizmo_controls();
  for (const KeyBinding& binding : kKeyBindings) {
    std::string how = words(binding.modifiers) + key_name(binding.key);
    if (binding.words.empty()) {
      lines.back().how += " or " + how;
    } else {
      lines.push_back({std::move(how), std::string(binding.words)});
    }
  }
  for (ControlLine& line : part_controls()) lines.push_back(std::move(line));
  return lines;
}

ControlLine control_of(Action action) {
  for (const KeyBinding& binding : kKeyBindings) {
    if (binding.action != action || binding.words.empty()) continue;
    std::string how = words(binding.modifiers) + key_name(binding.key);
    std::erase(how, ' ');
    return {std::move(how), std::string(binding.words)};
  }
  return {};
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
