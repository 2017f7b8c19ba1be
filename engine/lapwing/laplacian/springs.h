#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "lapwing/base/numbers.h"
#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// A spring that pulls a point of the surface to a position. It adds
///     stiffness |sum_k shares_k u(corner k) - prescribed|^2
/// to the energy. This is the constraint term of eq. 5, extended to points inside triangles.
struct Spring {
  std::array<Index, 3> corners{};  ///< corners of a triangle; all equal for a vertex
  std::array<double, 3> shares{};  ///< barycentric coordinates of the point
  Eigen::Vector3d prescribed = Eigen::Vector3d::Zero();  ///< displacement of the point
  double stiffness = 1.0;                                ///< positive, or kStiff
};

/// The stiffness of a spring or constrained vertex that is far stiffer than the surface.
/// LaplacianSystem replaces this value by a finite stiffness.
inline constexpr double kStiff = std::numeric_limits<double>::infinity();

/// Returns the springs with a finite stiffness instead of kStiff: 1e7 times the mean diagonal of A.
/// The error of the position is the force divided by the stiffness. With this value, rounding still
/// leaves 9 correct digits.
std::vector<Spring> with_finite_stiffness(std::span<const Spring> springs, const BlockMatrix& A);

/// Adds the matrix of the springs to A, for each component of a block. The pattern of A must
/// contain the edges of the springs' triangles.
void add_springs(std::span<const Spring> springs, const Unknowns& unknowns, BlockMatrix& A);

/// Adds the product of the springs' matrix and `u` to y, which has 3 numbers per unknown. `u` has
/// one vector per vertex of the mesh.
void add_spring_product(std::span<const Spring> springs, const Unknowns& unknowns,
                        std::span<const Eigen::Vector3d> u, std::span<double> y);

/// Returns the forces of the springs on the unknowns at displacement 0, 3 numbers per unknown.
/// Returns an empty list if there are no springs.
Numbers spring_forces(std::span<const Spring> springs, const Unknowns& unknowns);

}  // namespace lapwing
