#pragma once

#include <vector>

#include "lapwing/solve/block_cholesky/elimination_tree.h"

namespace lapwing::cholesky {

/// Groups of columns that are eliminated together, as nodes of a forest. Children are numbered
/// before their parents.
struct Supernodes {
  /// Nodes of the elimination tree in each supernode, ascending.
  std::vector<std::vector<int>> columns;
  std::vector<int> update_counts;  ///< number of rows below the columns
  std::vector<int> parent;         ///< -1 at the roots
  std::vector<std::vector<int>> children;
  std::vector<double> cost;  ///< estimated time for each supernode in ns, by `front_cost`
};

/// Returns the estimated time in nanoseconds to assemble and factorize a front of `pivots` pivots
/// and `updates` update rows. Only the ratio of two estimates is used. The constants were measured
/// on one AVX-512 core.
double front_cost(double pivots, double updates);

/// Returns the number of operations (additions and multiplications) to eliminate `pivots` columns.
double front_flops(double pivots, double updates);

/// Finds the fundamental supernodes, then merges children into their parents if that lowers the
/// estimated time: a few stored zeros cost less than many small fronts. Takes almost linear time.
Supernodes find_supernodes(const EliminationTree& tree, int block_size);

}  // namespace lapwing::cholesky
