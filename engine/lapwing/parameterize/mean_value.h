#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/patch/patch.h"

namespace lapwing {

/// The sparse rows of x_i - sum_j w_ij x_j = 0 for `inner`: own vertices of a patch off its
/// boundary, and columns by own numbers. The w_ij are mean value coordinates of vertex i in its
/// ring (Floater 2003, eq. 2.1), which are positive and sum to 1. Where triangles have no area,
/// angles and lengths are kept off their limits, so that weights stay finite and no neighbour loses
/// its hold.
BlockRows mean_value_rows(std::span<const Triangle> triangles,
                          std::span<const Eigen::Vector3d> own_positions,
                          std::span<const Index> inner);

/// How the systems of `mean_value_points` are solved.
enum class MapSolver {
  automatic,         ///< normal_equations; sparse_lu where these leave a residual or a fold
  normal_equations,  ///< our Cholesky of A'A, refined on the residual of A
  sparse_lu,         ///< Eigen's, refined likewise: slower, exact on stalks too
};

/// All points of the patch when those of its loop are `boundary`, in the loop's order. Throws
/// InputError as `mean_value_map` does where the patch has no area or no finite position.
std::vector<Eigen::Vector2d> mean_value_points(const Patch& patch,
                                               std::span<const Eigen::Vector3d> own_positions,
                                               std::span<const Eigen::Vector2d> boundary,
                                               MapSolver solver = MapSolver::automatic);

/// Largest |sum_j w_ij (x_j - x_i)| over the rows.
double largest_residual(const BlockRows& A, std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
