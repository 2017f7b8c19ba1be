#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// A linear map R S, or a weighted sum of such maps: R is a rotation or a sum of rotations, and S a
/// symmetric stretch or a sum of stretches.
struct LinearMap {
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();

  void add(double weight, const LinearMap& other) {
    R += weight * other.R;
    S += weight * other.S;
  }
};

/// Returns the mean map of a sum whose weights sum to 1. Its rotation is the rotation nearest to
/// the sum. (A mean of the products R S would be too small if the rotations differ.)
LinearMap mean_map(const LinearMap& sum);

/// The linear maps of a surface from rest to a pose, one for each triangle and each vertex.
///
/// The map F of a triangle maps its edges e1, e2 and the vector m = N / sqrt(|N|), N = e1 x e2,
/// exactly to those of the pose. The surface is thus stretched along its normal by the geometric
/// mean of the two stretches in its plane. F = R S is the polar decomposition. The map of a vertex
/// is the mean over its triangles, weighted by area.
class PoseMaps {
 public:
  /// The matrices that depend only on the rest shape.
  struct Rest {
    std::vector<Eigen::Matrix3d> inverse_frames;  ///< per triangle: [e1 e2 m]^-1
    std::vector<double> areas;                    ///< per triangle; 0 if it has no frame
  };
  static Rest prepare(const Topology& topology, std::span<const Eigen::Vector3d> rest);

  PoseMaps(const Topology& topology, const Rest& rest, std::span<const Eigen::Vector3d> posed);

  /// Returns the map at the point of a triangle with these barycentric coordinates. It is
  /// continuous over the surface. At the centroid it equals the map of the triangle. The area of
  /// the triangle at rest must be positive.
  LinearMap at(Index triangle, const std::array<double, 3>& weights) const;

 private:
  const Topology& topology_;
  std::vector<LinearMap> of_triangle_;
  std::vector<LinearMap> of_vertex_;  // sums whose weights sum to 1
};

/// Returns the area-weighted mean of the triangle maps at each vertex, as a sum whose weights sum
/// to 1. If all areas are 0, the sum is zero.
std::vector<LinearMap> maps_of_vertices(const Topology& topology, std::span<const double> areas,
                                        std::span<const LinearMap> of_triangle);

}  // namespace lapwing
