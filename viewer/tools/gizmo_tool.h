#pragma once

#include <optional>
#include <string>

#include "state/waypoints.h"
#include "tools/gizmo_drag.h"
#include "tools/gizmo_frame.h"
#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Moves a handle. The user drags an arm, ring or plane of the gizmo, or presses G, R or S and
/// moves the mouse. X, Y or Z restricts the drag to an axis, and with Shift to the plane
/// perpendicular to it. A second press of the same key switches between world axes and local axes.
/// A third press removes the restriction. The user can also type an exact value. Control snaps to
/// round values. W, E and Q (R in Maya) choose the gizmo. Enter or a click ends a drag. Escape or
/// the right mouse button cancels it.
class GizmoTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return drag_.has_value(); }
  const char* hint(const AppState& state, const Part& part) const override;

  /// Starts to drag the scene's handle in the view plane at `pixel`, with the left button.
  void take_hold(const Eigen::Vector2d& pixel, const ToolScene& scene);
  /// Sets the position of the cursor while another tool is active, because a key starts a drag
  /// there. Does nothing during a drag.
  void move_cursor(const Eigen::Vector2d& pixel) {
    if (!drag_) cursor_ = pixel;
  }
  /// The handle's move during a drag.
  const std::optional<Move>& move() const { return move_; }
  /// Returns whether the handle's orientation is free after the drag. It is free if the user drags
  /// the handle itself and has not rotated the handle before.
  HandleOrientation orientation() const {
    return pulls_ ? HandleOrientation::free : HandleOrientation::kept;
  }
  /// The waypoints of the drag so far.
  std::span<const Move> waypoints() const { return recorder_.waypoints(); }
  /// Sets the mode of the gizmo. Does nothing during a drag.
  void show(GizmoMode mode) {
    if (!drag_) mode_ = mode;
  }
  const GizmoChoices& choices() const { return choices_; }
  /// Takes effect at the next drag.
  void set_choices(const GizmoChoices& choices) { choices_ = choices; }
  GizmoMode mode() const { return drag_ ? drag_->mode() : mode_; }
  /// The part that is dragged or under the cursor.
  GizmoPart part() const { return drag_ ? drag_->part() : hovered_; }
  /// Returns the gizmo as drawn. It follows its handle.
  Gizmo gizmo(const AppState& state, std::size_t handle) const;
  /// Writes the status line of a drag to `text`, for example "turn 45 degrees about x". Adds a
  /// warning if the handle rotates by more than kLargestSettledTurnDegrees, because the surface may
  /// not follow a larger rotation.
  void read_out(std::string& text) const;

 private:
  ToolAnswer handle_key(const InputEvent& event, const ToolScene& scene);
  ToolAnswer handle_drag_key(const InputEvent& event, const ToolScene& scene);
  ToolAnswer handle_text(const InputEvent& event, const ToolScene& scene);
  void begin(GizmoMode mode, GizmoPart part, const ToolScene& scene);
  GizmoAxes axes() const;
  void renew(const ToolScene& scene);
  ToolAnswer confirm(const ToolScene& scene);
  void give_up();
  std::optional<double> typed_number() const;
  static bool has_no_user_rotation(const ToolScene& scene);
  Move move_before(const ToolScene& scene) const;

  GizmoChoices choices_;
  bool by_other_axes_ = false;  // of this drag
  GizmoMode mode_ = GizmoMode::translate;
  GizmoPart hovered_ = GizmoPart::none;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  bool snaps_ = false;

  std::optional<GizmoDrag> drag_;
  bool by_button_ = false;  // the drag ends when the button is released
  bool pulls_ = false;      // the drag pulls the handle itself
  WaypointRecorder recorder_;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  double snap_length_ = 1.0;
  std::string typed_;
  GizmoAmount amount_;
  std::optional<Move> move_;
  bool turns_too_far_ = false;  // of move_
};

}  // namespace lapwing::viewer
