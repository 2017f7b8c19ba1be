#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

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

}  // namespace lapwing
