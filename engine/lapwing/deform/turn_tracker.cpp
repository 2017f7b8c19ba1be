#include "lapwing/deform/turn_tracker.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

// Sine of half of 30 degrees. If the rotation is closer to a whole turn, rounding errors or an
// unsteady hand determine the axis.
const double kUncertainAxis = std::sin(15.0 * std::numbers::pi / 180.0);

}  // namespace

void TurnTracker::follow(const Eigen::Affine3d& motion) {
  if (!(motion.linear().determinant() > 0.0)) return;
  Quaterniond q(nearest_rotation(motion.linear()));
  if (q.dot(rotation_) < 0.0) q.coeffs() = -q.coeffs();
  rotation_ = q;
  const bool beyond_half_a_turn = turn_.norm() > std::numbers::pi;
  const Vector3d axis = beyond_half_a_turn && q.vec().norm() < kUncertainAxis
                            ? turn_.normalized()
                            : q.vec().normalized();
  constexpr double kPeriod = 4.0 * std::numbers::pi;
  const double angle = 2.0 * std::atan2(q.vec().dot(axis), q.w());
  turn_ = (angle + kPeriod * std::round((turn_.dot(axis) - angle) / kPeriod)) * axis;
}

double TurnTracker::degrees() const {
  return turn_.norm() * 180.0 / std::numbers::pi;
}

HandleMotions followed(const HandleMotions& last, std::span<const Eigen::Affine3d> maps) {
  HandleMotions motions;
  motions.maps.assign(maps.begin(), maps.end());
  for (std::size_t h = 0; h < maps.size(); ++h) {
    TurnTracker tracker = h < last.turns.size() ? TurnTracker(last.turns[h]) : TurnTracker();
    tracker.follow(maps[h]);
    motions.turns.push_back(tracker.turn());
  }
  return motions;
}

}  // namespace lapwing
