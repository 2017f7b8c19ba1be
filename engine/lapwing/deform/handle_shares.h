#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

/// How far every vertex goes along with each handle: 1 on it, 0 on the belt, smoothly between. From
/// these follow the scale s_i that the handles ask of the surface there, and where large rotations
/// settle from.
class HandleShares {
 public:
  /// Solves for the shares, one column of the n x n system for each handle. `system` holds that
  /// system, and must outlive the object.
  explicit HandleShares(const EditSystem& system);

  /// Of a handle, per vertex of the region, in the order of EditRegion::roi; 0 to 1. Those of all
  /// handles sum to at most 1, and to 1 where nothing else holds the region.
  std::span<const double> of_handle(std::size_t handle) const;

  /// s_i, per vertex of the mesh, for handles that scale by `handle_scales`: those by their shares,
  /// and the rest 1.
  std::vector<double> scales(std::span<const double> handle_scales) const;

  /// The displacement of every vertex where each makes a share of the handles' motions, and with it
  /// of their whole turns, whose rotations came about by `turns`: the surface is wound the way the
  /// handles went. A linear response knows a handle's
  /// rotation but not its turn.
  std::vector<Eigen::Vector3d> turned(std::span<const Eigen::Affine3d> motions,
                                      std::span<const Eigen::AngleAxisd> turns) const;

 private:
  const EditSystem& system_;
  std::vector<double> shares_;  ///< handle after handle
};

/// By how much a handle's motion scales it: the cube root of the determinant of its linear part, of
/// a motion that mirrors of its size, and kLeastScale at least.
double scale_of(const Eigen::Affine3d& motion);

/// What is flattened keeps this size in the energy, where 0 would leave its rotations open.
inline constexpr double kLeastScale = 1e-3;

}  // namespace lapwing
