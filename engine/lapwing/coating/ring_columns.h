#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/region_rings.h"

namespace lapwing {

/// x of all unknowns, then y, then z, as LaplacianSystem solves for: 3 n numbers. The unknowns are
/// the first n rows of the rings.
using Columns = std::vector<double>;

/// L u over the rows of `rings`: u_r - sum_j w_rj u_j; u is 0 on what is no unknown.
std::vector<Eigen::Vector3d> laplacians(const RegionRings& rings, const Columns& u, std::size_t n);

/// L' y over the unknowns, y one vector per row.
Columns transposed(const RegionRings& rings, std::span<const Eigen::Vector3d> y, std::size_t n);

/// The 2-norm.
double norm(const Columns& x);

}  // namespace lapwing
