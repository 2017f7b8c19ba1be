#pragma once

#include <vector>

#include <Eigen/Core>

#include "kernels/awkward_meshes.h"
#include "lapwing/laplacian/region_rings.h"

namespace lapwing::test {

/// A region of a sample mesh, and a displacement of the mesh.
struct TurnedRings {
  RegionRings rings;
  std::vector<Eigen::Vector3d> displacement;  ///< argument of RingRotations::fit_rotations

  /// C_i of RingRotations::fit_rotations.
  Eigen::Matrix3d covariance(std::size_t row) const;
  Eigen::Vector3d rest_laplacian(std::size_t row) const;
  Eigen::Vector3d moved_laplacian(std::size_t row) const;
  Eigen::Vector3d moved_edge(std::size_t row, std::size_t entry) const;
};

/// Returns a region in which two thirds of the vertices are rows, and most rows are unknowns. It
/// has cotangent weights, so w_ij and w_ji differ, and different row weights. The stiffness is
/// mu / 2 times the edge_weights, or absent if mu is 0. The displacement rotates the mesh by
/// `degrees` about a tilted axis and translates it far. It also moves each vertex at random by up
/// to `noise` mean edge lengths.
TurnedRings turned_rings(const Sample& sample, double degrees, double noise, double mu,
                         unsigned seed);

/// Returns a symmetric positive definite matrix for each of `count` rows. The matrices stretch by
/// 0.5 to 1.7, along axes that differ between rows.
std::vector<Eigen::Matrix3d> different_stretches(std::size_t count);

/// Returns the rotation axis of `turned_rings`.
Eigen::Vector3d turning_axis();

/// The results of fit_rotations.
struct Fitted {
  std::vector<Eigen::Matrix3d> transforms;
  std::vector<double> energies;
  std::vector<double> gradient;

  double energy() const;
};
Fitted fit(RingRotations& rotations, const TurnedRings& turned,
           std::span<const Eigen::Matrix3d> stretch = {});
Fitted fit(Kernels& kernels, const TurnedRings& turned,
           std::span<const Eigen::Matrix3d> stretch = {});

}  // namespace lapwing::test
