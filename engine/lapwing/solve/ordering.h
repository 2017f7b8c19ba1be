#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing {

enum class Ordering {
  automatic,          ///< minimum_degree up to kMinimumDegreeLimit blocks, nested_dissection above
  minimum_degree,     ///< AMD: a tenth of the time of nested dissection
  nested_dissection,  ///< METIS: a third fewer operations in the factorization of regular meshes
};

/// Up to this many blocks, nested dissection takes longer than it saves in one factorization. If
/// one pattern is factored repeatedly, nested dissection pays from 20,000 blocks on.
inline constexpr std::size_t kMinimumDegreeLimit = 150'000;

/// Returns a permutation of the block columns, new to old, that keeps the Cholesky factor sparse.
/// The same pattern gives the same order. Throws SolverError if METIS runs out of memory or the
/// graph has too many edges for its index type. For M'M of a mesh, `dissection_order` is faster.
std::vector<int> fill_reducing_order(const BlockPattern& pattern,
                                     Ordering ordering = Ordering::automatic);

struct EliminationOrder {
  std::vector<int> order;  ///< new to old
  /// Sum of the squared entry counts of the factor's block columns. This is the number of
  /// operations to factorize 1 x 1 blocks, and a 27th of that for 3 x 3 blocks.
  double operations = 0;
};

/// Returns `fill_reducing_order` by minimum degree, with its operations.
EliminationOrder minimum_degree_order(const BlockPattern& pattern);

/// Returns an approximate minimum degree (AMD) order of a graph, new to old. If `operations` is not
/// null, it is set to the value of EliminationOrder::operations. The call cannot be interrupted.
/// Throws SolverError if the graph has too many edges for 31-bit indices.
std::vector<int> minimum_degree(const BlockGraph& graph, double* operations = nullptr);

/// Returns the scalar permutation that keeps the rows of a block together.
std::vector<int> scalar_order(std::span<const int> order, int block_size);

}  // namespace lapwing
