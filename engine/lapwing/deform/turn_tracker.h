#pragma once

#include <Eigen/Geometry>

namespace lapwing {

/// If a handle turns by more than this relative to the belt, the surface may settle with another
/// winding, since the energy can be lower in the other direction. The length of the surface and the
/// detail length determine how much winding it keeps. A larger turn without a path is split into
/// substeps (modifiers/substeps.h).
inline constexpr double kLargestSettledTurnDegrees = 180.0;

/// Whether a turn exceeds the limit by more than the rounding error of a computed half turn.
inline bool exceeds_settled_turn(double degrees) {
  constexpr double kRoundingDegrees = 1e-6;
  return degrees > kLargestSettledTurnDegrees + kRoundingDegrees;
}

/// Beyond this turn, the direction of the turn matters: linear responses fail, surfaces can be
/// inside out, and `winding_degrees` measures the winding. This is also the default size of
/// substeps.
inline constexpr double kFarTurnDegrees = 90.0;

/// Accumulates the turn of one handle over the motions of a drag, also past 180 and 360 degrees.
/// Several rotation vectors (angle times axis) describe a motion's rotation; the tracker keeps the
/// one nearest to the last. It follows steps of less than 180 degrees, the first one from no turn.
/// A larger step counts as the shorter way round.
class TurnTracker {
 public:
  TurnTracker() = default;
  /// Continues from the accumulated `turn`.
  explicit TurnTracker(const Eigen::AngleAxisd& turn)
      : rotation_(turn), turn_(turn.angle() * turn.axis()) {}

  /// Adds the handle's next motion, a map from the rest position as in `DragSession::step`. The
  /// rotation is that of the polar decomposition. A motion that mirrors or flattens (determinant
  /// not above 0) has none and leaves the turn unchanged.
  void follow(const Eigen::Affine3d& motion);

  /// 0 or more.
  double degrees() const;
  /// Right-handed and of length 1, or 0 without a turn. Within 30 degrees of a whole turn the axis
  /// is poorly defined, so the previous one is kept.
  Eigen::Vector3d axis() const { return turn_.normalized(); }
  Eigen::AngleAxisd turn() const { return {turn_.norm(), axis()}; }

 private:
  // The sign of the quaternion follows the drag: a whole turn flips it.
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();  // radians times axis
};

}  // namespace lapwing
