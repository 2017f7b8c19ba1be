#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// Which fill-reducing ordering to use.
enum class Ordering {
  automatic,          ///< minimum_degree up to kMinimumDegreeLimit blocks, nested_dissection above
  minimum_degree,     ///< AMD: a tenth of the time of nested dissection
  nested_dissection,  ///< METIS: up to a third fewer operations in the factorization
};

/// Up to this many blocks nested dissection takes longer than it saves in one factorization.
/// Whoever factors one pattern again and again does better with nested dissection from 20'000
/// blocks on.
inline constexpr std::size_t kMinimumDegreeLimit = 150'000;

/// A permutation of the block columns, new to old, that keeps the Cholesky factor sparse. Works on
/// the graph of blocks, one node a vertex. The same pattern gives the same order. Throws
/// SolverError when the ordering library fails (out of memory).
std::vector<int> fill_reducing_order(const BlockPattern& pattern,
                                     Ordering ordering = Ordering::automatic);

/// The same by nested dissection of clusters of blocks, `cluster_of` each block, numbered from 0
/// without gaps: those of one cluster are eliminated one after the other. With clusters of four
/// neighbours on a surface it takes a sixth of the time of nested dissection, about that of
/// minimum degree, and the factorization 1.1 to 2.3 times the operations; minimum degree is at 2.1
/// to 3.4 on as many blocks (measured at 0.4 to 1 million, the more the more regular the mesh).
std::vector<int> clustered_order(const BlockPattern& pattern, std::span<const Index> cluster_of);

}  // namespace lapwing
