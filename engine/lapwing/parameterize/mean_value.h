#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/parameterize/patch.h"

namespace lapwing {

/// Returns the sparse rows of x_i - sum_j w_ij x_j = 0 for `inner`, the inner vertices of a patch.
/// The columns are local vertex indices. The w_ij are mean value coordinates of vertex i in its
/// ring (Floater 2003, eq. 2.1), which are positive and sum to 1. In degenerate triangles, angles
/// and lengths are clamped, so that the weights remain finite and positive.
BlockRows mean_value_rows(std::span<const Triangle> triangles,
                          std::span<const Eigen::Vector3d> own_positions,
                          std::span<const Index> inner);

/// Returns the 2D points of all vertices of the patch. `boundary` contains the points of its loop,
/// in the order of the loop. Solves the normal equations and refines the solution iteratively with
/// the residual of A. If the residual is still too large or triangles are folded, as on thin
/// protrusions, uses Eigen's SparseLU instead. Throws InputError as `mean_value_map` does if the
/// patch has zero area or a non-finite position.
std::vector<Eigen::Vector2d> mean_value_points(const Patch& patch,
                                               std::span<const Eigen::Vector3d> own_positions,
                                               std::span<const Eigen::Vector2d> boundary);

/// Returns the largest |sum_j w_ij (x_j - x_i)| over the rows.
double largest_residual(const BlockRows& A, std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
