#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/region_rings.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// Returns r_i^2 = sum_j w_ij |v_j - v_i|^2 for each of `rows`. If the weights sum to 1, r_i is the
/// radius of the ring, and 4 / r_i^2 times the row's Laplacian approximates the Laplace operator,
/// exactly for |x|^2. For cotangents, r_i^2 is four times the Voronoi area. Values are at least
/// kSmallestRingShare times their mean, so that none is 0. `weights` has one entry per entry of
/// `rings`.
std::vector<double> squared_rings(const Adjacency& rings, std::span<const double> weights,
                                  std::span<const Eigen::Vector3d> positions,
                                  std::span<const Index> rows);

inline constexpr double kSmallestRingShare = 1e-6;

double surface_area(std::span<const Triangle> triangles,
                    std::span<const Eigen::Vector3d> positions);

/// 3 n numbers: x of all unknowns, then y, then z, as in LaplacianSystem. The unknowns are the
/// first n rows of the rings.
using Columns = std::vector<double>;

/// Returns L u for the rows of `rings`: u_r - sum_j w_rj u_j, where u = 0 except at unknowns.
std::vector<Eigen::Vector3d> laplacians(const RegionRings& rings, const Columns& u, std::size_t n);

/// Returns L' y for the unknowns. y has one vector per row.
Columns transposed(const RegionRings& rings, std::span<const Eigen::Vector3d> y, std::size_t n);

double norm(const Columns& x);

}  // namespace lapwing
