#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/region_rings.h"
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

/// x of all unknowns, then y, then z, as in LaplacianSystem: 3 n numbers. The unknowns are the
/// first n rows of the rings.
using Columns = std::vector<double>;

/// Returns L u over the rows of `rings`: u_r - sum_j w_rj u_j, with u = 0 except at unknowns.
std::vector<Eigen::Vector3d> laplacians(const RegionRings& rings, const Columns& u, std::size_t n);

/// Returns L' y over the unknowns; y has one vector per row.
Columns transposed(const RegionRings& rings, std::span<const Eigen::Vector3d> y, std::size_t n);

/// The 2-norm.
double norm(const Columns& x);

}  // namespace lapwing
