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
  /// The accumulated turns behind the rotations of the maps, possibly beyond 180 degrees.
  std::vector<Eigen::AngleAxisd> turns;
  /// Not 0 if the handle's orientation is free: the map prescribes its centre and stretch, and the
  /// minimization finds its rotation. The map's rotation is only the starting point. Empty if no
  /// handle is free.
  std::vector<char> is_free = {};

  bool is_free_handle(std::size_t h) const { return h < is_free.size() && is_free[h] != 0; }
  bool any_free() const;
};

/// Returns the motions of `maps` with the shortest turns.
HandleMotions handle_motions(std::span<const Eigen::Affine3d> maps);

/// Numbers that describe one handle's motion: a 3 x 3 linear part and a translation.
inline constexpr std::size_t kMotionParameters = 12;

/// Coordinates in which a handle's displacement is linear in 12 numbers q, all lengths:
///     u_a(x) = sum_b q[4a + b] (x - c)_b / r + q[4a + 3],
/// c the centroid of the handle's vertices and r their largest distance from it, so that every
/// column moves the handle by about its parameter.
struct HandleFrame {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  double radius = 1.0;
  double extent = 0.0;  ///< the radius, but 0 for a single vertex
};
HandleFrame handle_frame(std::span<const Index> vertices,
                         std::span<const Eigen::Vector3d> positions);

/// The 12 parameters of `motion`. All exactly 0 for the identity.
void motion_parameters(const HandleFrame& frame, const Eigen::Affine3d& motion,
                       std::span<double> parameters);

/// Returns u(`position`) for the 12 parameters of its handle.
Eigen::Vector3d handle_displacement(const HandleFrame& frame, std::span<const double> parameters,
                                    const Eigen::Vector3d& position);

/// Returns the rotation of `motion` as a turn of 0 to 180 degrees, by the polar decomposition of
/// its linear part.
Eigen::AngleAxisd shortest_turn(const Eigen::Affine3d& motion);

/// Interpolates `motion` from the identity (`share` 0) to the whole motion (1). The rotation,
/// reached by `turn`, takes that share of its angle, the stretch S becomes (1 - share) I + share S,
/// and the handle's centroid moves on a line.
Eigen::Affine3d partial_motion(const Eigen::Affine3d& motion, const Eigen::AngleAxisd& turn,
                               const Eigen::Vector3d& centroid, double share);

/// Returns `map` with another rotation, but the same stretch and the same image of `centroid`.
Eigen::Affine3d turned_to(const Eigen::Affine3d& map, const Eigen::Vector3d& centroid,
                          const Eigen::Matrix3d& rotation);

}  // namespace lapwing
