#pragma once

#include <span>
#include <vector>

#include "lapwing/recipe/step.h"
#include "state/app_state.h"

namespace lapwing::viewer {

/// Returns whether the moves are made in substeps, each the rest shape of the next: if the
/// parameters say so, or if a handle turns far and has no path.
bool uses_substeps(const EditParameters& parameters, std::span<const HandleMove> moves);

/// Returns the diagonal of the ROI at rest, the unit of distances. Linear in its vertices.
double region_size(const AppState& state);

/// Returns whether the moves differ so much that solving from `from` directly to `to` may find a
/// different minimum, so that the path needs a waypoint. This is true if the handle rotates by 30
/// degrees, moves by a tenth of `region_size`, or stretches by a quarter.
bool are_far_apart(const Move& from, const Move& to, const Eigen::Vector3d& handle_centroid,
                   double region_size);

/// Returns whether the handle rotates by more than 90 degrees between the moves. The direction of
/// rotation is then ambiguous.
bool is_jump(const Move& from, const Move& to);

/// Selects waypoints from the successive moves of a gesture: each is far from the one before, the
/// first from `start`.
class WaypointRecorder {
 public:
  WaypointRecorder() = default;
  WaypointRecorder(Move start, const Eigen::Vector3d& handle_centroid, double region_size);

  void add(const Move& move);
  bool has_jumped() const { return has_jumped_; }
  /// Empty after a jump, such as a typed number.
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
/// Then adds the path of `to`, along which `handle` moves while the others rest. Clears all paths
/// if the surface does not go on from its pose: after a jump, and after moves in substeps.
void extend_path(AppState& state, std::size_t handle, const HandleMove& to);

}  // namespace lapwing::viewer
