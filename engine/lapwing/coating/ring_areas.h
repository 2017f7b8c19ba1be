#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns sum_j w_ij |v_j - v_i|^2 for each of `rows`. For weights that sum to 1 this is the
/// squared radius of the ring, and 4 / it turns the row's Laplacian into the Laplace operator,
/// exactly for |x|^2. For cotangents it is four times the Voronoi area. Values are at least
/// kSmallestRingShare of their mean, so that none is 0. `weights` has one entry per entry of
/// `rings`.
std::vector<double> squared_rings(const Adjacency& rings, std::span<const double> weights,
                                  std::span<const Eigen::Vector3d> positions,
                                  std::span<const Index> rows);

inline constexpr double kSmallestRingShare = 1e-6;

double surface_area(std::span<const Triangle> triangles,
                    std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing
