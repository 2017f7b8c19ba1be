#pragma once

#include <vector>

#include "lapwing/solve/block_cholesky/elimination_graph.h"

namespace lapwing::cholesky {

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
