#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing {

enum class Ordering {
  automatic,       ///< minimum_degree up to kMinimumDegreeLimit blocks, nested_dissection above
  minimum_degree,  ///< AMD; takes a tenth of the time of nested dissection
  /// METIS; for regular meshes, the factorization needs a third fewer operations.
  nested_dissection,
};

/// Up to this number of blocks, nested dissection takes more time than it saves in a single
/// factorization. If a pattern is factorized repeatedly, it saves time from 20,000 blocks on.
inline constexpr std::size_t kMinimumDegreeLimit = 150'000;

/// Returns a permutation of the block columns, new to old, that keeps the Cholesky factor sparse.
/// The order depends only on the pattern and `ordering`. Throws SolverError if METIS runs out of
/// memory or the graph has too many edges for its index type. For M'M of a mesh, `dissection_order`
/// is faster.
std::vector<int> fill_reducing_order(const BlockPattern& pattern,
                                     Ordering ordering = Ordering::automatic);

struct EliminationOrder {
  std::vector<int> order;  ///< new to old
  /// Sum of the squared entry counts of the factor's block columns. This is the number of
  /// operations to factorize a matrix of 1 x 1 blocks. Blocks of 3 x 3 need 27 times as many.
  double operations = 0;
};

/// Returns `fill_reducing_order` by minimum degree, with its operations.
EliminationOrder minimum_degree_order(const BlockPattern& pattern);

/// Returns an approximate minimum degree (AMD) order of a graph, new to old. If `operations` is not
/// null, it is set to the value of EliminationOrder::operations. The call cannot be interrupted.
/// Throws SolverError if the graph has too many edges for 31-bit indices.
std::vector<int> minimum_degree(const BlockGraph& graph, double* operations = nullptr);

/// Returns the permutation of scalar rows that permutes the blocks by `order` and keeps the rows of
/// each block consecutive.
std::vector<int> scalar_order(std::span<const int> order, int block_size);

}  // namespace lapwing
