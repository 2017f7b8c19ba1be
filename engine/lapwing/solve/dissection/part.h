#pragma once

#include <vector>

#include "lapwing/solve/dissection/mesh_dissection.h"
#include "lapwing/solve/dissection/separator.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// A set of nodes to be ordered. Unknowns have weight 1, nodes that only couple unknowns have
/// weight 0. Edges have no weights.
struct Part {
  WeightedGraph graph;
  Groups groups;           ///< nodes are numbered group by group
  std::vector<int> nodes;  ///< index of each node in the whole graph
  int first = 0;           ///< start of the part's range in the order
  int unknowns = 0;
};

Part whole_part(const CouplingGraph& graph);

/// Returns the unknowns on `side` outside the separator, and the adjacent nodes that couple them.
/// Does not set `first`.
Part side_of(const Part& part, const ThickSeparator& separator, int side);

}  // namespace lapwing::dissection
