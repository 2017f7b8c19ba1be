#pragma once

#include <vector>

#include "lapwing/solve/block_cholesky/elimination_tree.h"

namespace lapwing::cholesky {

/// Groups of columns that are eliminated together, as the nodes of a forest. Numbered so that
/// children come before their parents.
struct Supernodes {
  std::vector<std::vector<int>> columns;  ///< nodes of the elimination tree, ascending
  std::vector<int> update_counts;         ///< rows below the columns
  std::vector<int> parent;                ///< -1 at the roots
  std::vector<std::vector<int>> children;
  std::vector<double> cost;  ///< estimated time of each in ns, by `front_cost`
};

/// Estimated nanoseconds to assemble and factor a front of `pivots` pivots and `updates` update
/// rows. Only ratios matter; the constants were measured on one AVX-512 core.
double front_cost(double pivots, double updates);

/// Operations (an addition and a multiplication count two) that eliminate `pivots` columns.
double front_flops(double pivots, double updates);

/// Fundamental supernodes, then children merged into their parents while that lowers the estimated
/// time: a few zeros stored are cheaper than many small fronts. Almost linear time.
Supernodes find_supernodes(const EliminationTree& tree, int block_size);

}  // namespace lapwing::cholesky
