#pragma once

#include <span>
#include <vector>

#include "lapwing/recipe/step.h"
#include "state/app_state.h"

namespace lapwing::viewer {

/// Returns whether the moves are made in substeps: if the parameters request substeps, or if a
/// handle rotates by more than 180 degrees and no handle has a path.
bool uses_substeps(const EditParameters& parameters, std::span<const HandleMove> moves);

/// Returns the diagonal of the ROI's bounding box at rest. Takes time linear in the ROI's size.
double region_size(const AppState& state);

/// Returns whether the moves differ so much that solving from `from` directly to `to` may find a
/// different minimum, so that the path needs a waypoint. This is true if the handle rotates by 30
/// degrees, moves by a tenth of `region_size`, or stretches by a quarter.
bool are_far_apart(const Move& from, const Move& to, const Eigen::Vector3d& handle_centroid,
                   double region_size);

/// Returns whether the handle rotates by more than 90 degrees between the moves. The direction of
/// rotation is then ambiguous.
bool is_jump(const Move& from, const Move& to);

/// Selects waypoints from the successive moves of a gesture. Each waypoint is far from the previous
/// one (`are_far_apart`), and the first waypoint is far from `start`.
class WaypointRecorder {
 public:
  WaypointRecorder() = default;
  WaypointRecorder(Move start, const Eigen::Vector3d& handle_centroid, double region_size);

  void add(const Move& move);
  bool has_jumped() const { return has_jumped_; }
  /// Returns the waypoints. Empty after a jump, for example after the user typed a rotation.
  std::span<const Move> waypoints() const {
    return has_jumped_ ? std::span<const Move>() : waypoints_;
  }

 private:
  Move last_;      // the last move added
  Move last_far_;  // the last waypoint, or the start
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  double region_size_ = 0.0;
  bool has_jumped_ = false;
  std::vector<Move> waypoints_;
};

/// Adds the current moves of all handles to their paths if they are far from the last waypoint.
/// Then adds the waypoints of `to`; the other handles do not move along them. If the next solve
/// does not start from the current pose, clears all paths instead: after a jump or with substeps.
void extend_path(AppState& state, std::size_t handle, const HandleMove& to);

}  // namespace lapwing::viewer
