#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "lapwing/base/numbers.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// A point of the surface that is drawn to a place: stiffness |sum_k shares_k u(corner k) -
/// wanted|^2 in the energy (eq. 5's held vertices, for points within triangles too).
struct Spring {
  std::array<Index, 3> corners{};                    ///< of one triangle; all the same for a vertex
  std::array<double, 3> shares{};                    ///< of the corners; they sum to 1
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();  ///< displacement
  double stiffness = 1.0;  ///< above 0; kStiff stands for far more than the surface's own
};

inline constexpr double kStiff = std::numeric_limits<double>::infinity();

/// With a number in place of kStiff: this many times the mean of the diagonal of A. What is off is
/// the force over that, and rounding still leaves 9 digits.
std::vector<Spring> with_finite_stiffness(std::span<const Spring> springs, const BlockMatrix& A);

/// A += the matrix of the springs over the unknowns, for each of the block's directions. The
/// pattern must hold the edges of their triangles.
void add_springs(std::span<const Spring> springs, const Unknowns& unknowns, BlockMatrix& A);

/// y += that matrix times u, u given for the whole mesh: 3 numbers per unknown.
void add_spring_product(std::span<const Spring> springs, const Unknowns& unknowns,
                        std::span<const Eigen::Vector3d> u, std::span<double> y);

/// What the springs pull the unknowns by where nothing is displaced: 3 numbers per unknown; nothing
/// without springs.
Numbers spring_forces(std::span<const Spring> springs, const Unknowns& unknowns);

}  // namespace lapwing
