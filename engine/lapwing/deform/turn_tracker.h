#pragma once

#include <span>

#include <Eigen/Geometry>

#include "lapwing/deform/handle_motion.h"

namespace lapwing {

/// If a handle turns by more than this relative to the belt, the surface may settle with a
/// different winding, because a turn in the other direction can have a lower energy. The largest
/// stable winding depends on the length of the surface and on the detail length. A larger turn is
/// split into substeps unless a path is given (modifiers/substeps.h).
inline constexpr double kLargestSettledTurnDegrees = 180.0;

/// Returns true if a turn exceeds kLargestSettledTurnDegrees by more than rounding errors. A half
/// turn does not exceed it.
inline bool exceeds_settled_turn(double degrees) {
  constexpr double kRoundingDegrees = 1e-6;
  return degrees > kLargestSettledTurnDegrees + kRoundingDegrees;
}

/// For turns larger than this, linear responses are inaccurate, surfaces can turn inside out, and
/// `winding_degrees` measures the winding. This is also the default size of substeps.
inline constexpr double kFarTurnDegrees = 90.0;

/// Accumulates the turn of one handle over the motions of a drag, also past 180 and 360 degrees.
/// Several rotation vectors (angle times axis) represent the rotation of a motion; the tracker
/// chooses the one nearest to the previous vector. It starts without a turn. Each step must be less
/// than 180 degrees; a larger step is interpreted as a turn in the other direction.
class TurnTracker {
 public:
  TurnTracker() = default;
  /// Continues from the accumulated `turn`.
  explicit TurnTracker(const Eigen::AngleAxisd& turn)
      : rotation_(turn), turn_(turn.angle() * turn.axis()) {}

  /// Adds the handle's next motion, a map from the rest position as in `DragSession::step`. The
  /// rotation is that of the polar decomposition. A motion whose determinant is zero or negative
  /// does not define a rotation and leaves the turn unchanged.
  void follow(const Eigen::Affine3d& motion);

  /// The angle of the accumulated turn, 0 or more.
  double degrees() const;
  /// The axis of the right-handed turn, of length 1, or 0 without a turn. Within 30 degrees of a
  /// whole turn, the axis is ill-conditioned, so the previous axis is used.
  Eigen::Vector3d axis() const { return turn_.normalized(); }
  Eigen::AngleAxisd turn() const { return {turn_.norm(), axis()}; }

 private:
  // The sign of the quaternion is continuous over the drag, so it is opposite after a whole turn.
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();  // axis times angle in radians
};

/// Returns the motions for `maps`, which follow the motions `last` in a drag: the turns continue
/// those of `last`. An empty `last` means no turn.
HandleMotions followed(const HandleMotions& last, std::span<const Eigen::Affine3d> maps);

}  // namespace lapwing
