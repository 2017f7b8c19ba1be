#pragma once

#include <vector>

#include "lapwing/solve/dissection/mesh_dissection.h"
#include "lapwing/solve/dissection/separator.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// A set of nodes to be ordered. Unknowns weigh 1, nodes that only couple weigh 0, and edges have
/// no weights.
struct Part {
  WeightedGraph graph;
  Groups groups;           ///< nodes are numbered group by group
  std::vector<int> nodes;  ///< number of each node in the whole graph
  int first = 0;           ///< place of its first unknown in the order
  int unknowns = 0;
};

Part whole_part(const CouplingGraph& graph);

/// Returns the part on `side` outside the separator, and the nodes that couple it. Leaves `first`
/// unset.
Part side_of(const Part& part, const ThickSeparator& separator, int side);

}  // namespace lapwing::dissection
