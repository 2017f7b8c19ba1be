#pragma once

#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// Which fill-reducing ordering to use.
enum class Ordering {
  automatic,          ///< amd up to kMinimumDegreeLimit blocks, nested_dissection above
  minimum_degree,     ///< AMD: a tenth of the time of nested dissection
  nested_dissection,  ///< METIS: up to a third fewer operations in the factorization
};

/// Up to this many blocks the time that nested dissection takes is more than it saves in one
/// factorization.
inline constexpr std::size_t kMinimumDegreeLimit = 30'000;

/// A permutation of the block columns, new to old, that keeps the Cholesky factor sparse. Works on
/// the graph of blocks, one node a vertex. The same pattern gives the same order. Throws
/// SolverError when the ordering library fails (out of memory).
std::vector<int> fill_reducing_order(const BlockPattern& pattern,
                                     Ordering ordering = Ordering::automatic);

}  // namespace lapwing
