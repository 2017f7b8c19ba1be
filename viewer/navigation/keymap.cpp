#include "navigation/keymap.h"

#include <algorithm>
#include <cctype>
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
    {{kHome, kPlain, Action::frame_all, "Frame all"},
     {'F', kPlain, Action::frame_selection, "Frame selected, or all"},
     {'.', kPlain, Action::frame_selection},
     {'1', kPlain, Action::view_front, "Front view"},
     {'1', kControl, Action::view_back, "Back view"},
     {'3', kPlain, Action::view_right, "Right view"},
     {'3', kControl, Action::view_left, "Left view"},
     {'7', kPlain, Action::view_top, "Top view"},
     {'7', kControl, Action::view_bottom, "Bottom view"},
     {'0', kPlain, Action::view_three_quarter, "Three-quarter view"},
     {'5', kPlain, Action::toggle_projection, "Toggle perspective and orthographic"},
     {kLeft, kPlain, Action::orbit_left, "Orbit left"},
     {kRight, kPlain, Action::orbit_right, "Orbit right"},
     {kUp, kPlain, Action::orbit_up, "Orbit up"},
     {kDown, kPlain, Action::orbit_down, "Orbit down"},
     {'=', kPlain, Action::zoom_in, "Zoom in"},
     {'-', kPlain, Action::zoom_out, "Zoom out"},
     {'Z', kShift, Action::toggle_wireframe, "Toggle wireframe"},
     {'Z', kAlt, Action::toggle_xray, "Toggle X-ray: a transparent surface with its edges"},
     {'L', kShift, Action::toggle_flat, "Toggle flat shading"},
     {kTab, kPlain, Action::toggle_panels, "Toggle panels"},
     {'?', kPlain, Action::toggle_controls, "Show the controls"},
     {kF1, kPlain, Action::toggle_controls},
     {'I', kPlain, Action::choose_roi, "Select the region to edit"},
     {'H', kPlain, Action::choose_handle, "Select the handle"},
     {'H', kShift, Action::add_handle, "Add a handle"},
     {'T', kPlain, Action::choose_belt, "Select the fixed border by hand"},
     {'G', kShift, Action::take_grab,
      "Grab: drag the surface. Shift: smaller area, Ctrl: larger area. [ and ] resize the circle"},
     {'D', kPlain, Action::take_disk,
      "Disk: drag from its centre to its edge, or click. [ and ] or a dot on its edge resize it"},
     {'O', kPlain, Action::take_loop, "Loop: click points, close the loop, click the side to keep"},
     {'P', kPlain, Action::take_brush, "Brush: paint. [ and ] resize it, Ctrl erases"},
     {'L', kPlain, Action::take_lasso, "Lasso: draw around vertices. Ctrl erases"},
     {'B', kPlain, Action::take_box, "Box: drag over vertices. Ctrl erases"},
     {'V', kPlain, Action::take_pin,
      "Pin: press on a vertex to pin it and drag. Shift: only pin or select it"},
     {'P', kShift, Action::take_stiffness,
      "Stiffness: paint rigid, stiff or soft parts. [ and ] resize the brush, Ctrl erases"},
     {'U', kPlain, Action::take_ruler,
      "Measure: distance between two points, straight and along the surface. Escape removes it"},
     {'M', kPlain, Action::take_move,
      "Move: drag the handle by its gizmo. Elsewhere, the left button orbits the view"},
     {kEscape, kPlain, Action::take_move},
     {',', kPlain, Action::next_gizmo_axes, "Next gizmo orientation: World, Local, Normal"},
     {kTab, kShift, Action::toggle_sticking,
      "Toggle snapping of the moved handle to the surface beside the region"},
     {kEnter, kPlain, Action::go_on, "Continue from the region to the handle, then to Move"},
     {'N', kControl, Action::new_edit, "New edit: keep the result, clear the selection"},
     {'A', kControl, Action::select_all, "Select all"},
     {'A', kControlShift, Action::clear, "Select none"},
     {'=', kControl, Action::grow, "Grow selection by one ring"},
     {'-', kControl, Action::shrink, "Shrink selection by one ring"},
     {'I', kControl, Action::invert, "Invert selection"},
     {kDelete, kPlain, Action::remove_handle, "Remove the handle"},
     {'N', kPlain, Action::take_part, "Pick up a part; press again for the next part"},
     {'N', kShift, Action::take_up_part, "Pick up the last transplant again"},
     {'C', kPlain, Action::toggle_before, "Toggle the original mesh, to compare"},
     {'C', kShift, Action::toggle_slider,
      "Toggle a dividing line that you can drag, with the original mesh on its left"},
     {'K', kControl, Action::begin_coat, "Coat the region with the detail of another patch"},
     {'M', kShift, Action::toggle_mirror, "Toggle mirroring in the symmetry plane of the shape"},
     {'M', kControl, Action::begin_mix, "Mix the detail of two patches on the region"},
     {'K', kControlShift, Action::open_source, "Open another mesh as the source of a coat or mix"},
     {'K', kShift, Action::other_source, "Show the other source of a mix"},
     {'K', kPlain, Action::pick_pairs, "Toggle picking of corresponding points"},
     {kEnter, kControl, Action::apply_step, "Apply the coat, mix or wrap"},
     {'Z', kControl, Action::undo, "Undo"},
     {'Z', kControlShift, Action::redo, "Redo"},
     {'Y', kControl, Action::redo},
     {'O', kControl, Action::open, "Open"},
     {'S', kControl, Action::save, "Save the mesh. The first time, choose a file"},
     {'S', kControlShift, Action::save_as, "Save the mesh as another file"},
     {'E', kControl, Action::save_recipe, "Save the steps as a recipe"},
     {'R', kControl, Action::replay_recipe, "Replay a recipe on this mesh"},
     {'P', kControl, Action::save_picture, "Save an image"},
     {'P', kControlShift, Action::save_turntable,
      "Save a turntable, as a video or an image sequence"},
     {'Q', kControl, Action::quit, "Quit"}});

// The descriptions of the motions, indexed by Motion.
constexpr std::array<std::string_view, 3> kMotions{"Orbit", "Pan", "Zoom"};

std::string name_of(MouseButton button) {
  return button == MouseButton::left ? "left" : button == MouseButton::middle ? "middle" : "right";
}

std::string capitalized(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
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

// Returns the controls of the axis gizmo and of GizmoTool.
std::vector<ControlLine> gizmo_controls() {
  return {{"Click on an end of the axis gizmo", "Look along this axis"},
          {"Left drag on the axis gizmo", "Orbit"},
          {"Left drag on a handle", "Pull it. The surface determines its rotation"},
          {"G, R, S", "Move, rotate, scale the handle (Maya: R scales, E rotates)"},
          {"X, Y, Z while moving",
           "Constrain to an axis. Again: switch between local and world axes. Shift: constrain to "
           "a plane"},
          {"0 to 9, ., - and e while moving", "Type the value"},
          {"Ctrl while moving", "Snap to increments"},
          {"Enter or click, Escape or right click", "Confirm, cancel"},
          {"W, E, Q", "Switch the gizmo to move, rotate or scale"}};
}

// Returns the keys of PlaceTool.
std::vector<ControlLine> part_controls() {
  return {{"Ctrl + wheel, [ and ], with a part picked up", "Scale it. Shift + wheel rotates it"},
          {"G, Enter, Escape, with a part placed", "Pick it up again, apply, cancel"}};
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
const Keymap& keymap_named(std::string_view name) {
  const auto found = std::ranges::find(kKeymaps, name, &Keymap::name);
  return found == std::end(kKeymaps) ? *std::begin(kKeymaps) : *found;
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
    lines.push_back({capitalized(words(binding.modifiers) + name_of(binding.button) + " drag"),
                     std::string(kMotions[static_cast<std::size_t>(binding.motion)])});
  }
  lines.push_back({"Wheel", "Zoom to the point under the cursor"});
  lines.push_back({words(kSizes) + "wheel", "Resize the last disk, or the brush"});
  lines.push_back({"Left click", "Show vertex, face and position"});
  lines.push_back({"Drop a file", "Open it"});
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
  std::string text = row({"Keymap", "Input", "Action"}) + "|---|---|---|\n";
  for (const Keymap& keymap : kKeymaps) {
    for (const ControlLine& line : mouse_controls(keymap)) {
      text += row({std::string(keymap.name), line.how, line.what});
    }
  }
  for (const ControlLine& line : key_controls()) text += row({"All", line.how, line.what});
  return text;
}

}  // namespace lapwing::viewer
