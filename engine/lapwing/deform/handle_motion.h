#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The motions of an edit's handles. Each list has one entry per handle.
struct HandleMotions {
  /// Affine maps from the rest position.
  std::vector<Eigen::Affine3d> maps;
  /// The accumulated turns of the maps' rotations, which may exceed 180 degrees.
  std::vector<Eigen::AngleAxisd> turns;
  /// Not 0 if the handle's orientation is free: the map prescribes its centre and stretch, and the
  /// minimization finds its rotation. The map's rotation is only the starting point. Empty if no
  /// handle is free.
  std::vector<char> is_free = {};

  bool is_free_handle(std::size_t h) const { return h < is_free.size() && is_free[h] != 0; }
  bool any_free() const;
};

/// Returns the motions for `maps`, with the shortest turn of each rotation.
HandleMotions handle_motions(std::span<const Eigen::Affine3d> maps);

/// Number of parameters of one handle's motion: a 3 x 3 linear part and a translation.
inline constexpr std::size_t kMotionParameters = 12;

/// Coordinates of a handle, in which its displacement is linear in 12 parameters q. All parameters
/// are lengths:
///     u_a(x) = sum_b q[4a + b] (x - c)_b / r + q[4a + 3],
/// where c is the centroid of the handle's vertices and r their largest distance from c. A
/// parameter of 1 thus displaces the handle by about 1.
struct HandleFrame {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double radius = 1.0;
  double extent = 0.0;  ///< equal to `radius`, but 0 if all vertices coincide
};
HandleFrame handle_frame(std::span<const Index> vertices,
                         std::span<const Eigen::Vector3d> positions);

/// Computes the 12 parameters of `motion`. They are exactly 0 for the identity.
void motion_parameters(const HandleFrame& frame, const Eigen::Affine3d& motion,
                       std::span<double> parameters);

/// Returns the displacement u(`position`) for the 12 parameters of a handle.
Eigen::Vector3d handle_displacement(const HandleFrame& frame, std::span<const double> parameters,
                                    const Eigen::Vector3d& position);

/// Returns the rotation of `motion` as a turn of 0 to 180 degrees. Uses the polar decomposition of
/// its linear part.
Eigen::AngleAxisd shortest_turn(const Eigen::Affine3d& motion);

/// Interpolates `motion` from the identity (`share` 0) to the whole motion (1). `turn` is the
/// rotation of the whole motion; its angle is multiplied by `share`. The stretch S becomes (1 -
/// share) I + share S, and the handle's centroid moves along a straight line.
Eigen::Affine3d partial_motion(const Eigen::Affine3d& motion, const Eigen::AngleAxisd& turn,
                               const Eigen::Vector3d& centroid, double share);

/// Returns `map` with its rotation replaced by `rotation`. The stretch and the image of `centroid`
/// do not change.
Eigen::Affine3d turned_to(const Eigen::Affine3d& map, const Eigen::Vector3d& centroid,
                          const Eigen::Matrix3d& rotation);

}  // namespace lapwing
