#pragma once

#include <vector>

#include "lapwing/solve/block_cholesky/elimination_tree.h"

namespace lapwing::cholesky {

/// Groups of columns that are eliminated together, as nodes of a forest. Children are numbered
/// before their parents.
struct Supernodes {
  std::vector<std::vector<int>> columns;  ///< nodes of the elimination tree, ascending
  std::vector<int> update_counts;         ///< rows below the columns
  std::vector<int> parent;                ///< -1 at the roots
  std::vector<std::vector<int>> children;
  std::vector<double> cost;  ///< estimated time of each in ns, by `front_cost`
};

/// Returns the estimated nanoseconds to assemble and factorize a front of `pivots` pivots and
/// `updates` update rows. Only ratios matter; the constants were measured on one AVX-512 core.
double front_cost(double pivots, double updates);

/// Returns the operations (an addition and a multiplication count two) to eliminate `pivots`
/// columns.
double front_flops(double pivots, double updates);

/// Finds the fundamental supernodes, then merges children into their parents while that lowers the
/// estimated time: a few stored zeros cost less than many small fronts. Almost linear time.
Supernodes find_supernodes(const EliminationTree& tree, int block_size);

}  // namespace lapwing::cholesky
