#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/parameterize/patch.h"

namespace lapwing {

/// Returns the sparse rows of x_i - sum_j w_ij x_j = 0 for `inner`, the own vertices of a patch off
/// its boundary, with columns by own numbers. The w_ij are mean value coordinates of vertex i in
/// its ring (Floater 2003, eq. 2.1), which are positive and sum to 1. In triangles without area,
/// angles and lengths are kept off their limits, so that weights stay finite and positive.
BlockRows mean_value_rows(std::span<const Triangle> triangles,
                          std::span<const Eigen::Vector3d> own_positions,
                          std::span<const Index> inner);

/// Returns all points of the patch if `boundary` are those of its loop, in the loop's order. Solves
/// the normal equations and refines the solution with the residual of A. If a residual or a fold
/// remains, as on thin protrusions, solves by Eigen's SparseLU instead. Throws InputError as
/// `mean_value_map` does if the patch has no area or is not finite.
std::vector<Eigen::Vector2d> mean_value_points(const Patch& patch,
                                               std::span<const Eigen::Vector3d> own_positions,
                                               std::span<const Eigen::Vector2d> boundary);

/// Returns the largest |sum_j w_ij (x_j - x_i)| over the rows.
double largest_residual(const BlockRows& A, std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
