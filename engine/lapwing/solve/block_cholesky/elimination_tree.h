#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing::cholesky {

/// The off-diagonal blocks of a pattern, each listed at whichever of its two columns is eliminated
/// first. Columns are numbered by their places in the order of elimination.
struct EliminationGraph {
  std::vector<int> places;  ///< place of each column of the pattern
  std::vector<int> starts;
  /// Column j is coupled with later[starts[j], starts[j+1]), eliminated after it, ...
  std::vector<int> later;
  std::vector<int> blocks;  ///< ... in these blocks of the pattern

  int size() const { return static_cast<int>(places.size()); }
};

/// `order` is new to old. Throws SolverError if there are 2^31 blocks or more.
EliminationGraph elimination_graph(const BlockPattern& pattern, std::span<const int> order);

/// Elimination tree of a symmetric pattern. Nodes are numbered in postorder: the descendants of j
/// are the nodes before it.
struct EliminationTree {
  std::vector<int> columns;  ///< column of the graph at each node, in postorder
  std::vector<int> parent;   ///< -1 at the root of each component
  std::vector<int> counts;   ///< entries of each column of the factor, diagonal included
};

/// Builds the tree (Liu 1986) and its column counts (Gilbert, Ng, Peyton 1994) in almost linear
/// time.
EliminationTree build_elimination_tree(const EliminationGraph& graph);

}  // namespace lapwing::cholesky
