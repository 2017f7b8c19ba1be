#pragma once

#include <Eigen/Geometry>

namespace lapwing {

/// Beyond this turn of a handle against the belt a surface may settle wound otherwise than the
/// handle went, since the energy is lower the other way round: how much winding it holds depends on
/// its length and the detail length (a cylinder six diameters long holds 300 degrees with the
/// default, and not with sixty times that). A larger turn without a path is made in parts, each the
/// rest shape of the next (modifiers/substeps.h).
inline constexpr double kLargestSettledTurnDegrees = 180.0;

/// Beyond this turn the direction of a rotation matters: linear responses are of no use, windings
/// are measured, and surfaces can be inside out. A turn that is made in parts is made in parts of
/// this size: a bar six widths long keeps 720 degrees so.
inline constexpr double kFarTurnDegrees = 90.0;

/// How far one handle has turned in all over the motions of a drag, past 180 and 360 degrees too,
/// where the motion alone no longer tells. Of the rotation vectors (angle times axis) that stand
/// for a motion's rotation it keeps the one nearest to the last. Steps of less than 180 degrees
/// from one motion to the next are followed right, the first one counted from no turn; a larger one
/// is taken for the short way round.
class TurnTracker {
 public:
  TurnTracker() = default;
  /// Goes on from a motion that came about by `turn`.
  explicit TurnTracker(const Eigen::AngleAxisd& turn)
      : rotation_(turn), turn_(turn.angle() * turn.axis()) {}

  /// The handle's next motion, from the rest position as `DragSession::step` takes it. Of a linear
  /// part that stretches the rotation of the polar decomposition counts; one that mirrors or
  /// flattens (determinant not above 0) has none, and the turn stays.
  void follow(const Eigen::Affine3d& motion);

  /// 0 or more.
  double degrees() const;
  /// Right-handed, of length 1; 0 where there is no turn. Within 30 degrees of a whole turn, where
  /// the rotation hardly tells its axis, the one before.
  Eigen::Vector3d axis() const { return turn_.normalized(); }
  Eigen::AngleAxisd turn() const { return {turn_.norm(), axis()}; }

 private:
  // Of the two quaternions of a rotation the one that the drag came to: a whole turn changes sign.
  Eigen::Quaterniond rotation_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();  // radians times axis
};

}  // namespace lapwing
