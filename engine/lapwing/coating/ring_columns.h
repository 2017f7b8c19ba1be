#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/region_rings.h"

namespace lapwing {

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
