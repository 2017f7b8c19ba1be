#pragma once

#include <Eigen/SparseCore>

#include "lapwing/solve/block_matrix.h"

namespace lapwing::bench {

/// The scalar lower triangle of a block matrix in compressed columns, for libraries without blocks.
using ScalarLower = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Returns the pattern alone, with values 0. Throws SolverError if it has 2^31 entries or more.
ScalarLower scalar_lower_pattern(const BlockPattern& pattern, int block_size);

/// Writes the values of `matrix` into `lower`, which must come from `scalar_lower_pattern`.
void fill_scalar_lower(const BlockMatrix& matrix, ScalarLower& lower);

}  // namespace lapwing::bench
