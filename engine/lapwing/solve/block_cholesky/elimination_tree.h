#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing::cholesky {

/// The off-diagonal blocks of a pattern, each listed at whichever of its two columns is eliminated
/// first. Columns are numbered in elimination order.
struct EliminationGraph {
  std::vector<int> places;  ///< position of each column of the pattern in the elimination order
  std::vector<int> starts;
  /// Column j is coupled with the columns later[starts[j], starts[j+1]), which are eliminated after
  /// j.
  std::vector<int> later;
  std::vector<int> blocks;  ///< number of each such block in the pattern

  int size() const { return static_cast<int>(places.size()); }
};

/// `order` is new to old. Throws SolverError if there are 2^31 blocks or more.
EliminationGraph elimination_graph(const BlockPattern& pattern, std::span<const int> order);

/// Elimination tree of a symmetric pattern. Nodes are numbered in postorder: the descendants of
/// node j directly precede j.
struct EliminationTree {
  std::vector<int> columns;  ///< graph column of each node
  std::vector<int> parent;   ///< -1 at the root of each component
  /// Number of entries in each column of the factor, including the diagonal.
  std::vector<int> counts;
};

/// Builds the tree (Liu 1986) and its column counts (Gilbert, Ng, Peyton 1994) in almost linear
/// time.
EliminationTree build_elimination_tree(const EliminationGraph& graph);

}  // namespace lapwing::cholesky
