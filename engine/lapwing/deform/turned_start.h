#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

/// Turns of a handle up to this many degrees settle from the linear solution, larger ones from the
/// turned start. Measured on a whole scan: from 30 degrees on the turned start is ahead.
inline constexpr double kLargestLinearTurnDegrees = 15.0;

/// Where settling starts for large rotations: every vertex makes a share of each handle's motion,
/// and with it of the handle's whole turn, so that the surface is wound the way the handle went.
/// The linear solution knows a handle's rotation but not its turn, and loses detail on the way:
/// a twist of 179 degrees settles from it the other way round, or after 96 iterations in place of
/// 7; from here 260 degrees keep their winding.
class TurnedStart {
 public:
  /// Solves for the shares, one column of the n x n system for each handle. `system` holds that
  /// system, and must outlive the object.
  explicit TurnedStart(const EditSystem& system);

  /// The displacement of every vertex for motions whose rotations came about by `turns`.
  std::vector<Eigen::Vector3d> displacement(std::span<const Eigen::Affine3d> motions,
                                            std::span<const Eigen::AngleAxisd> turns) const;

 private:
  const EditSystem& system_;
  std::vector<double> shares_;  ///< handle after handle, per unknown; 0 to 1, at most 1 in all
};

}  // namespace lapwing
