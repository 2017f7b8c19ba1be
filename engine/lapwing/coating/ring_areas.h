#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// sum_j w_ij |v_j - v_i|^2 for each of `rows`. For weights that sum to 1 the square of the ring's
/// radius: 4 / it turns the row's Laplacian into the Laplace operator, exactly so for |x|^2. For
/// cotangents four times the Voronoi area. Never below kSmallestRingShare of its mean, so that
/// rings without extent have one. `weights` has one entry per entry of `rings`.
std::vector<double> squared_rings(const Adjacency& rings, std::span<const double> weights,
                                  std::span<const Eigen::Vector3d> positions,
                                  std::span<const Index> rows);

inline constexpr double kSmallestRingShare = 1e-6;

/// The area of all `triangles`.
double surface_area(std::span<const Triangle> triangles,
                    std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
