#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

/// The stretch that scaling handles prescribe for the surface.
struct RestStretch {
  /// S_i of every ring, per vertex of the mesh: symmetric and positive definite; the identity
  /// outside the region. Empty if no handle changes its size.
  std::vector<Eigen::Matrix3d> of_vertices;
  /// The smooth map x -> common x + u (up to a translation), from which the S_i are computed.
  Eigen::Matrix3d common = Eigen::Matrix3d::Identity();
  std::vector<Eigen::Vector3d> u;  ///< per vertex of the mesh; empty: u is 0
};

/// Computes the rest stretch for the handles' motions. It stretches the rest shape of the rings, so
/// a scaling handle widens or narrows the surface around it without displacing it.
///
/// A smooth map x -> x + u interpolates the stretches of the handles, each about the handle's
/// centroid. u is the solution of the n x n system of `system`. In the tangent plane, S_i is the
/// stretch of the linear map that best fits this map over the ring. Along the normal, S_i stretches
/// by the geometric mean of the two tangential stretches. If only handles constrain the region and
/// all have the same stretch P, every S_i is P.
RestStretch rest_stretch(const EditSystem& system, std::span<const Eigen::Affine3d> motions);

/// Returns the mean scale of each stretch, the cube root of its determinant.
std::vector<double> mean_scales(std::span<const Eigen::Matrix3d> stretches);

}  // namespace lapwing
