#include "tools/gizmo_tool.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "lapwing/deform/turn_tracker.h"

namespace lapwing::viewer {
namespace {

using Eigen::Vector2d;

constexpr std::array<const char*, 3> kAxisNames{"X", "Y", "Z"};

void append_direction(std::string& text, GizmoPart part, GizmoMode mode, GizmoAxes axes) {
  if (part == GizmoPart::view) return;
  text += mode == GizmoMode::rotate ? " about " : is_plane(part) ? " locking " : " along ";
  if (axes == GizmoAxes::local) text += "local ";
  if (axes == GizmoAxes::normal) text += "normal ";
  text += kAxisNames[static_cast<std::size_t>(axis_of(part))];
}

void append(std::string& text, const char* format, double a, double b = 0.0, double c = 0.0) {
  std::array<char, 160> more{};
  std::snprintf(more.data(), more.size(), format, a, b, c);
  text += more.data();
}

// Returns 0 to 2 for X, Y and Z, else -1.
int axis_of_key(int key) {
  return key >= 'X' && key <= 'Z' ? key - 'X' : -1;
}

// Returns the drag that a key begins.
std::optional<GizmoMode> drag_of_key(int key, GizmoKeys keys) {
  if (key == 'G') return GizmoMode::translate;
  if (key == 'S') return GizmoMode::scale;
  if (key == 'R' && keys != GizmoKeys::maya) return GizmoMode::rotate;
  return std::nullopt;
}

// Returns whether the character may follow `typed`. An exponent needs a digit before it.
bool continues_number(const std::string& typed, char32_t c) {
  if ((c >= U'0' && c <= U'9') || c == U'.' || c == U'-') return true;
  return (c == U'e' || c == U'E') && typed.find_first_of("0123456789") != std::string::npos;
}

}  // namespace

const char* GizmoTool::hint(const AppState& state, const Part&) const {
  if (!state.selection.handles.empty()) return "Drag the gizmo, or press G, R or S.";
  return state.selection.roi.vertices.empty() ? "Press I to select the region."
                                              : "Press H to select a handle.";
}

Gizmo GizmoTool::gizmo(const AppState& state, std::size_t handle) const {
  const Eigen::Vector3d centroid = handle_centroid(state, handle);
  const Move move = move_ ? *move_ : shown_move(state, handle);
  const Eigen::Affine3d motion = to_affine(move, centroid);
  return {mode(), gizmo_center(choices_, state, handle, motion),
          gizmo_axes(axes(), state, handle, motion)};
}

GizmoAxes GizmoTool::axes() const {
  if (!by_other_axes_) return choices_.axes;
  return choices_.axes == GizmoAxes::world ? GizmoAxes::local : GizmoAxes::world;
}

ToolAnswer GizmoTool::handle(const InputEvent& event, const ToolScene& scene) {
  snaps_ = event.modifiers.control;
  if (event.kind == InputKind::key) return handle_key(event, scene);
  if (event.kind == InputKind::text) return handle_text(event, scene);
  if (event.kind == InputKind::scroll) return ToolAnswer::passed_on();
  cursor_ = event.position;
  if (!drag_) {
    if (event.kind == InputKind::release) return ToolAnswer::passed_on();
    hovered_ = hit_gizmo(gizmo(scene.state, scene.handle), scene.projection, cursor_);
    if (event.kind == InputKind::move || event.button != MouseButton::left ||
        hovered_ == GizmoPart::none) {
      return ToolAnswer::passed_on();
    }
    begin(mode_, hovered_, scene);
    by_button_ = true;
    return ToolAnswer::only_taken();
  }
  if (event.kind == InputKind::press && event.button == MouseButton::right) {
    give_up();
    return ToolAnswer::only_taken();
  }
  drag_->move_to(cursor_);
  renew(scene);
  const auto ends = by_button_ ? InputKind::release : InputKind::press;
  if (event.kind == ends && event.button == MouseButton::left) return confirm(scene);
  return ToolAnswer::only_taken();
}

ToolAnswer GizmoTool::handle_key(const InputEvent& event, const ToolScene& scene) {
  if (drag_) return handle_drag_key(event, scene);
  // Control+S, Shift+G and similar shortcuts are not the gizmo's.
  if (event.modifiers != Modifiers{}) return ToolAnswer::passed_on();
  const bool scales_in_maya = event.key == 'R' && scene.keys == GizmoKeys::maya;
  if (const auto mode = mode_of_key(scales_in_maya ? 'Q' : event.key)) {
    mode_ = *mode;
    return ToolAnswer::only_taken();
  }
  if (const auto mode = drag_of_key(event.key, scene.keys)) {
    begin(*mode, GizmoPart::view, scene);
    by_button_ = false;
    return ToolAnswer::only_taken();
  }
  return ToolAnswer::passed_on();
}

ToolAnswer GizmoTool::handle_drag_key(const InputEvent& event, const ToolScene& scene) {
  if (event.key == kEscape) {
    give_up();
    return ToolAnswer::only_taken();
  }
  if (event.key == kEnter) return confirm(scene);
  GizmoMode mode = drag_->mode();
  GizmoPart part = drag_->part();
  bool by_other_axes = by_other_axes_;
  if (event.key == kBackspace) {
    if (!typed_.empty()) typed_.pop_back();
  } else if (const int axis = axis_of_key(event.key); axis >= 0) {
    // Turning in a plane is turning about its axis, so Shift has no effect.
    const bool plane = event.modifiers.shift && mode != GizmoMode::rotate;
    part = part_of_axis(axis, plane);
    const bool again = part == drag_->part();
    if (again && by_other_axes) part = GizmoPart::view;
    by_other_axes = again && !by_other_axes;
  } else if (const auto other = drag_of_key(event.key, scene.keys)) {
    mode = *other;
  }
  if (mode != drag_->mode() || part != drag_->part() || by_other_axes != by_other_axes_) {
    const bool by_button = by_button_;
    const Vector2d cursor = std::exchange(cursor_, start_);
    std::string typed = typed_;
    give_up();
    by_other_axes_ = by_other_axes;
    begin(mode, part, scene);
    by_button_ = by_button;
    cursor_ = cursor;
    typed_ = std::move(typed);
    drag_->move_to(cursor_);
  }
  renew(scene);
  return ToolAnswer::only_taken();
}

ToolAnswer GizmoTool::handle_text(const InputEvent& event, const ToolScene& scene) {
  if (!drag_) return ToolAnswer::passed_on();
  if (continues_number(typed_, event.text)) {
    typed_ += static_cast<char>(event.text);
    renew(scene);
  }
  return ToolAnswer::only_taken();
}

void GizmoTool::take_hold(const Vector2d& pixel, const ToolScene& scene) {
  if (drag_) return;
  cursor_ = pixel;
  snaps_ = false;
  pulls_ = allows_free_handles(scene.state.parameters) && has_no_user_rotation(scene);
  begin(GizmoMode::translate, GizmoPart::view, scene);
  by_button_ = true;
}

// Returns whether the user has left the orientation alone. If not, a pull must not change it.
bool GizmoTool::has_no_user_rotation(const ToolScene& scene) {
  const HandleMove& to = scene.state.moves[scene.handle];
  if (to.orientation == HandleOrientation::free) return true;
  const auto* similarity = std::get_if<SimilarityMove>(&to.move);
  return similarity != nullptr && similarity->rotate == AxisRotation{};
}

// Returns the move that a drag continues. A pull leaves the handle free to turn; any other drag
// keeps the orientation that is shown.
Move GizmoTool::move_before(const ToolScene& scene) const {
  return pulls_ ? scene.state.moves[scene.handle].move : shown_move(scene.state, scene.handle);
}

void GizmoTool::begin(GizmoMode mode, GizmoPart part, const ToolScene& scene) {
  Gizmo there = gizmo(scene.state, scene.handle);
  there.mode = mode;
  if (mode == GizmoMode::translate && choices_.sticks_to_surface) {
    // The centroid sticks to the surface, wherever the pivot is.
    const Eigen::Vector3d centroid = handle_centroid(scene.state, scene.handle);
    there.center = to_affine(move_before(scene), centroid) * centroid;
  }
  recorder_ = WaypointRecorder(move_before(scene), handle_centroid(scene.state, scene.handle),
                               region_size(scene.state));
  start_ = cursor_;
  snap_length_ = snap_length(there, scene.projection);
  drag_.emplace(there, part, scene.projection, start_);
  renew(scene);
}

void GizmoTool::renew(const ToolScene& scene) {
  if (choices_.sticks_to_surface && drag_->mode() == GizmoMode::translate && scene.pick_still) {
    if (const auto under = scene.pick_still(cursor_)) drag_->move_center_to(under->position);
  }
  std::optional<SnapSteps> snap;
  if (snaps_) snap = SnapSteps{.length = snap_length_};
  amount_ = drag_->amount(snap, typed_number());
  move_ =
      drag_->move_after(move_before(scene), handle_centroid(scene.state, scene.handle), amount_);
  recorder_.add(*move_);
  // A jump is solved in substeps.
  turns_too_far_ = !scene.state.parameters.commit_every && !recorder_.has_jumped() &&
                   exceeds_settled_turn(turn_of(*move_).degrees);
}

ToolAnswer GizmoTool::confirm(const ToolScene& scene) {
  ToolAnswer answer = ToolAnswer::only_taken();
  if (*move_ != move_before(scene)) {
    const std::span<const Move> path = waypoints();
    answer.command = MoveHandle{scene.handle, {*move_, orientation(), {path.begin(), path.end()}}};
  }
  give_up();
  return answer;
}

void GizmoTool::give_up() {
  drag_.reset();
  move_.reset();
  pulls_ = false;
  by_other_axes_ = false;
  turns_too_far_ = false;
  typed_.clear();
}

std::optional<double> GizmoTool::typed_number() const {
  char* end = nullptr;
  const double number = std::strtod(typed_.c_str(), &end);
  if (end == typed_.c_str() || *end != '\0') return std::nullopt;
  return number;
}

void GizmoTool::read_out(std::string& text) const {
  text.clear();
  if (!drag_) return;
  switch (drag_->mode()) {
    case GizmoMode::translate:
      append(text, "Move (%.4g, %.4g, %.4g)", amount_.lengths.x(), amount_.lengths.y(),
             amount_.lengths.z());
      break;
    case GizmoMode::rotate:
      append(text, "Rotate %.4g°", amount_.degrees);
      break;
    case GizmoMode::scale:
      append(text, "Scale (%.4g, %.4g, %.4g)", amount_.factors.x(), amount_.factors.y(),
             amount_.factors.z());
  }
  append_direction(text, drag_->part(), drag_->mode(), axes());
  if (!typed_.empty()) text.append(" [").append(typed_).append("]");
  if (turns_too_far_) {
    append(text, ". %.4g° in total: the surface may rotate the other way. Rotate in several steps.",
           turn_of(*move_).degrees);
  }
}

}  // namespace lapwing::viewer
