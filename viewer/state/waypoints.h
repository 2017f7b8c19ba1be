#pragma once

#include <span>
#include <vector>

#include "lapwing/step/deform_step.h"
#include "state/app_state.h"

namespace lapwing::viewer {

/// Whether the moves are made in parts, each the rest shape of the next: as the parameters say, or
/// because a handle turns far and nothing says by which way.
bool goes_in_substeps(const EditParameters& parameters, std::span<const HandleMove> moves);

/// The diagonal of the ROI at rest, by which ways are measured. Linear in its vertices.
double region_size(const AppState& state);

/// Whether the surface may need to be told of one move to come from the other to the same place:
/// the handle turns by 30 degrees, goes by a tenth of the region's size, or stretches by a quarter.
bool are_far_apart(const Move& from, const Move& to, const Eigen::Vector3d& handle_centroid,
                   double region_size);

/// Whether the way from one move to the other is open, since a handle turns by more than 90
/// degrees: the surface does not go on from where it was.
bool is_jump(const Move& from, const Move& to);

/// Of the moves of a gesture, one after the other, those that are worth a waypoint: each far from
/// the one before, the first from `start`.
class WaypointRecorder {
 public:
  WaypointRecorder() = default;
  WaypointRecorder(Move start, const Eigen::Vector3d& handle_centroid, double region_size);

  void add(const Move& move);
  bool has_jumped() const { return has_jumped_; }
  /// Empty once there was a jump, as in a number that is typed.
  std::span<const Move> waypoints() const {
    return has_jumped_ ? std::span<const Move>() : waypoints_;
  }

 private:
  Move last_;      // added
  Move last_far_;  // and a waypoint, or the start
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  double region_size_ = 0.0;
  bool has_jumped_ = false;
  std::vector<Move> waypoints_;
};

/// Adds to the paths of all handles where they are now, if that is far from the last waypoint, and
/// then the path of `to`, which `handle` goes through while the others rest. Clears all paths if
/// the surface does not go on from where it is: for a jump, and for moves that were made in parts.
void extend_path(AppState& state, std::size_t handle, const HandleMove& to);

}  // namespace lapwing::viewer
