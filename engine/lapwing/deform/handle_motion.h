#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Where the handles of an edit go. Each list has one entry per handle.
struct HandleMotions {
  /// Affine maps from the rest position.
  std::vector<Eigen::Affine3d> maps;
  /// The turns that the rotations of the maps came about by, which may be more than half a turn.
  std::vector<Eigen::AngleAxisd> turns;
  /// Not 0 for a handle whose orientation is free: its centre goes where the map says and its shape
  /// is stretched as the map stretches it, but it turns as the surface wants. The map's rotation
  /// says only where settling starts. Empty if no handle is free.
  std::vector<char> is_free = {};

  bool is_free_handle(std::size_t h) const { return h < is_free.size() && is_free[h] != 0; }
  bool any_free() const;
};

/// Maps whose rotations came about by the shortest turns.
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
  double extent = 0.0;  ///< the same, and 0 for one vertex
};
HandleFrame handle_frame(std::span<const Index> vertices,
                         std::span<const Eigen::Vector3d> positions);

/// The 12 parameters of `motion`. All exactly 0 for the identity.
void motion_parameters(const HandleFrame& frame, const Eigen::Affine3d& motion,
                       std::span<double> parameters);

/// u of a point at `position` by the 12 numbers of its handle.
Eigen::Vector3d handle_displacement(const HandleFrame& frame, std::span<const double> parameters,
                                    const Eigen::Vector3d& position);

/// The rotation of `motion` as a turn of 0 to 180 degrees: that of the polar decomposition of its
/// linear part.
Eigen::AngleAxisd shortest_turn(const Eigen::Affine3d& motion);

/// `motion` carried out in part, `share` 0 (the identity) to 1 (all of it): its rotation, which
/// came about by `turn`, turns by the share of that angle, its stretch S becomes (1 - share) I +
/// share S, and the handle's centroid goes straight.
Eigen::Affine3d partial_motion(const Eigen::Affine3d& motion, const Eigen::AngleAxisd& turn,
                               const Eigen::Vector3d& centroid, double share);

/// `map` with another rotation: it stretches alike and takes `centroid` to the same place.
Eigen::Affine3d turned_to(const Eigen::Affine3d& map, const Eigen::Vector3d& centroid,
                          const Eigen::Matrix3d& rotation);

}  // namespace lapwing
