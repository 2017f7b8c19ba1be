#pragma once

#include <vector>

#include <Eigen/Core>

#include "kernels/awkward_meshes.h"
#include "lapwing/laplacian/region_rings.h"

namespace lapwing::test {

/// A part of a sample as a region, and where a displacement takes it.
struct TurnedRings {
  RegionRings rings;
  std::vector<Eigen::Vector3d> displacement;  ///< as RingRotations::fit_rotations takes it

  /// C_i of RingRotations::fit_rotations.
  Eigen::Matrix3d covariance(std::size_t row) const;
  Eigen::Vector3d rest_laplacian(std::size_t row) const;
  Eigen::Vector3d moved_laplacian(std::size_t row) const;
  Eigen::Vector3d moved_edge(std::size_t row, std::size_t entry) const;
};

/// Two thirds of the vertices are rows, most of those unknowns; weights are cotangent ones, so that
/// w_ij and w_ji differ, rows weigh differently, and edges have mu / 2 times their edge_weights as
/// stiffness, none where mu is 0. Turned by `degrees` about a tilted axis, moved far, and every
/// vertex moved at random by up to `noise` of the mean edge.
TurnedRings turned_rings(const Sample& sample, double degrees, double noise, double mu,
                         unsigned seed);

/// A symmetric positive definite matrix for each of `count` rows, stretching by 0.5 to 1.7 along
/// axes of no two rows alike.
std::vector<Eigen::Matrix3d> different_stretches(std::size_t count);

/// The axis that `turned_rings` turns about.
Eigen::Vector3d turning_axis();

}  // namespace lapwing::test
