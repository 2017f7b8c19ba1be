#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "editing/surface_view.h"

namespace lapwing::viewer {

/// Moves the shown surface with the gizmo's drag, and settles it during the drag if the user wants
/// that. After the drag, it shows the same motion until the result is computed.
class LiveDrag {
 public:
  LiveDrag(EditSession& session, const ActiveTool& active, SurfaceView& view)
      : session_(session), active_(active), view_(view) {}

  /// Call this when the gizmo has begun a drag. `is_of_last_step` is true if the press that begins
  /// the drag has also chosen the handle, so that both are one step.
  void begin(bool is_of_last_step = false);
  bool is_of_last_step() const { return is_of_last_step_; }
  /// Requests the result of the earlier moves. Call this when the gizmo has cancelled its drag.
  void give_up();
  /// Lets the next motion start from the present surface.
  void hold_pose();
  /// Call this when the state has changed, after SurfaceView::take_state.
  void take_state();
  /// Shows the frame of a drag. Call this once per frame.
  void update();

  /// Returns whether the surface settles during a drag, within the time budget of a frame. This
  /// requires the user's preference (`wants_to_settle`) and `parameters.settle`.
  bool settles() const { return wants_to_settle_ && session_.state().parameters.settle; }
  bool wants_to_settle() const { return wants_to_settle_; }
  void set_wants_to_settle(bool on) { wants_to_settle_ = on; }
  /// Returns whether the displayed surface starts from a settled pose of the current drag.
  bool shows_live_result() const;
  /// Returns the union of `bounds` and the bounds of the surface that the drag moves.
  Bounds united_with(Bounds bounds) const;

 private:
  const AppState& state() const { return session_.state(); }
  void turn_free_handles();
  Eigen::Affine3d pose_map(std::size_t handle) const;
  Eigen::Vector3d centroid_of(std::size_t handle) const;
  void limit_lead();
  void settle();

  EditSession& session_;
  const ActiveTool& active_;
  SurfaceView& view_;
  bool wants_to_settle_ = true;
  bool is_of_last_step_ = false;
  double longest_lead_ = 0.0;
  std::vector<Eigen::Affine3d> motions_;
  std::vector<std::size_t> dragged_;
  std::vector<HandleMove> moves_;
  std::optional<LiveResult> live_;                        // last result of a drag
  std::optional<std::vector<HandleMove>> resting_moves_;  // requested while the mouse rests
  std::shared_ptr<const DragState> dragged_from_;         // pose before the drag
};

}  // namespace lapwing::viewer
