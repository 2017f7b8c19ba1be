#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// Which fill-reducing ordering to use.
enum class Ordering {
  automatic,          ///< minimum_degree up to kMinimumDegreeLimit blocks, nested_dissection above
  minimum_degree,     ///< AMD: a tenth of the time of nested dissection
  nested_dissection,  ///< METIS: a third fewer operations in the factorization of regular meshes
};

/// Up to this many blocks nested dissection takes longer than it saves in one factorization.
/// Whoever factors one pattern again and again does better with nested dissection from 20'000
/// blocks on.
inline constexpr std::size_t kMinimumDegreeLimit = 150'000;

/// A permutation of the block columns, new to old, that keeps the Cholesky factor sparse. Works on
/// the graph of blocks, one node a vertex. The same pattern gives the same order. Throws
/// SolverError when METIS fails (out of memory) or the graph is too large to be numbered. For M'M
/// of a mesh `dissection_order` (dissection/mesh_dissection.h) takes at most 1.04 of the operations
/// that METIS's order takes, and half the time to find.
std::vector<int> fill_reducing_order(const BlockPattern& pattern,
                                     Ordering ordering = Ordering::automatic);

struct MinimumDegreeOrder {
  std::vector<int> order;  ///< new to old
  /// Of the counts of entries in the factor's block columns, squared and added up: what it takes to
  /// factor in 1 x 1 blocks, and a 27th of that in 3 x 3 blocks, in operations.
  double operations = 0;
};

/// `fill_reducing_order` by minimum degree, and what it is worth.
MinimumDegreeOrder minimum_degree_order(const BlockPattern& pattern);

}  // namespace lapwing
