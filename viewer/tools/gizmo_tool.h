#pragma once

#include <optional>
#include <string>

#include "state/waypoints.h"
#include "tools/gizmo_drag.h"
#include "tools/gizmo_frame.h"
#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Moves a handle: by dragging a part of the gizmo, or by G, R or S and the mouse alone, held to an
/// axis by X, Y, Z, to a plane by Shift with them, and by numbers typed. Control snaps. W, E and Q
/// (in Maya R) choose what the gizmo shows. Enter or a click ends a drag, Escape or the right
/// button gives it up.
///
/// The gizmo stands as the choices say. X, Y and Z go by its axes; the same again by the other ones
/// (the handle's own in place of the world's, the world's in place of any other), and once more
/// lets go of the axis.
class GizmoTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return drag_.has_value(); }
  const char* hint(const AppState& state, const Part& part) const override;

  /// The scene's handle is dragged in the plane of the view from `pixel` on, by the left button.
  void take_hold(const Eigen::Vector2d& pixel, const ToolScene& scene);
  /// The handle's move while it is dragged.
  const std::optional<Move>& move() const { return move_; }
  /// What becomes of its orientation: free in a pull of the handle itself, unless somebody has
  /// turned it before; kept by the gizmo and by keys.
  HandleOrientation orientation() const {
    return pulls_ ? HandleOrientation::free : HandleOrientation::kept;
  }
  /// What the handle has gone through while it is dragged.
  std::span<const Move> waypoints() const { return recorder_.waypoints(); }
  /// What the gizmo shows from now on; nothing while it is dragged.
  void show(GizmoMode mode) {
    if (!drag_) mode_ = mode;
  }
  const GizmoChoices& choices() const { return choices_; }
  /// From the next drag on.
  void set_choices(const GizmoChoices& choices) { choices_ = choices; }
  GizmoMode mode() const { return drag_ ? drag_->mode() : mode_; }
  /// The part dragged or under the cursor.
  GizmoPart part() const { return drag_ ? drag_->part() : hovered_; }
  /// Where the gizmo is drawn: it goes with its handle.
  Gizmo gizmo(const AppState& state, std::size_t handle) const;
  /// Whether the handle, dragged as it is, has turned farther from rest than the surface surely
  /// follows at once (kLargestSettledTurnDegrees), and nothing is committed on the way.
  bool turns_too_far() const { return turns_too_far_; }
  /// For the status line while dragging: "turn 45 degrees about x", and what to do where it turns
  /// too far.
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
  static bool is_turned_by_nobody(const ToolScene& scene);
  Move move_before(const ToolScene& scene) const;

  GizmoChoices choices_;
  bool by_other_axes_ = false;  // this drag
  GizmoMode mode_ = GizmoMode::translate;
  GizmoPart hovered_ = GizmoPart::none;
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  bool snaps_ = false;

  std::optional<GizmoDrag> drag_;
  bool by_button_ = false;  // ends with its release
  bool pulls_ = false;      // the handle itself was taken hold of
  WaypointRecorder recorder_;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  double snap_length_ = 1.0;
  std::string typed_;
  GizmoAmount amount_;
  std::optional<Move> move_;
  bool turns_too_far_ = false;  // of the live move
};

}  // namespace lapwing::viewer
