#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

/// What the handles' stretches ask of the surface.
struct RestStretch {
  /// S_i of every ring, per vertex of the mesh: symmetric and positive definite, the identity
  /// outside the region. Empty if no handle changes its size.
  std::vector<Eigen::Matrix3d> of_vertices;
  /// The smooth map that the S_i are taken from: x -> common x + u, up to a translation.
  Eigen::Matrix3d common = Eigen::Matrix3d::Identity();
  std::vector<Eigen::Vector3d> u;  ///< per vertex of the mesh; empty for 0
};

/// The rest stretch that the handles' motions ask for. What is stretched is the shape that a ring
/// keeps, so that a handle that scales widens or narrows the surface around it without pushing it
/// along.
///
/// A smooth map x -> x + u is made from the handles' stretches alone, each about the handle's
/// centroid and without its rotation and translation; u solves the n x n system. S_i is the stretch
/// of the ring's linear fit to that map in the tangent plane, and along the normal the geometric
/// mean of the two tangential stretches. If handles alone hold the region and all stretch alike, by
/// P, every S_i is P, so that a uniform scaling of all that is held scales the mesh exactly.
///
/// The n x n system of `system` is held. Costs one solve of three right-hand sides.
RestStretch rest_stretch(const EditSystem& system, std::span<const Eigen::Affine3d> motions);

/// Whether every motion is a rotation with a translation, but for rounding: no handle changes its
/// size.
bool are_rigid(std::span<const Eigen::Affine3d> motions);

/// By how much each stretch changes sizes: the cube root of its determinant.
std::vector<double> mean_scales(std::span<const Eigen::Matrix3d> stretches);

}  // namespace lapwing
