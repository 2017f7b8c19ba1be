#pragma once

#include <vector>

#include <Eigen/Core>

#include "kernels/awkward_meshes.h"
#include "lapwing/laplacian/region_rings.h"

namespace lapwing::test {

/// A part of a sample as a region, and a displacement of it.
struct TurnedRings {
  RegionRings rings;
  std::vector<Eigen::Vector3d> displacement;  ///< argument of RingRotations::fit_rotations

  /// C_i of RingRotations::fit_rotations.
  Eigen::Matrix3d covariance(std::size_t row) const;
  Eigen::Vector3d rest_laplacian(std::size_t row) const;
  Eigen::Vector3d moved_laplacian(std::size_t row) const;
  Eigen::Vector3d moved_edge(std::size_t row, std::size_t entry) const;
};

/// Two thirds of the vertices are rows, and most of these are unknowns. The weights are cotangent
/// weights, so w_ij and w_ji differ; the row weights differ, too. The stiffness is mu / 2 times the
/// edge_weights, or none if mu is 0. The displacement rotates the mesh by `degrees` about a tilted
/// axis, moves it far, and moves each vertex at random by up to `noise` mean edges.
TurnedRings turned_rings(const Sample& sample, double degrees, double noise, double mu,
                         unsigned seed);

/// Symmetric positive definite matrices for `count` rows, which stretch by 0.5 to 1.7 along axes
/// that differ from row to row.
std::vector<Eigen::Matrix3d> different_stretches(std::size_t count);

/// The axis of rotation of `turned_rings`.
Eigen::Vector3d turning_axis();

/// Results of a fit.
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
