#pragma once

#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// Which fill-reducing ordering to use.
enum class Ordering {
  automatic,          ///< minimum_degree up to kMinimumDegreeLimit blocks, nested_dissection above
  minimum_degree,     ///< AMD: a tenth of the time of nested dissection
  nested_dissection,  ///< METIS: up to a third fewer operations in the factorization
};

/// Up to this many blocks nested dissection takes longer than it saves in one factorization. Whoever
/// factors one pattern again and again does better with nested dissection from 20'000 blocks on.
inline constexpr std::size_t kMinimumDegreeLimit = 150'000;

/// A permutation of the block columns, new to old, that keeps the Cholesky factor sparse. Works on
/// the graph of blocks, one node a vertex. The same pattern gives the same order. Throws
/// SolverError when the ordering library fails (out of memory).
std::vector<int> fill_reducing_order(const BlockPattern& pattern,
                                     Ordering ordering = Ordering::automatic);

}  // namespace lapwing
