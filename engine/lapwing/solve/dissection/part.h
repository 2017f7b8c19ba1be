#pragma once

#include <vector>

#include "lapwing/solve/dissection/coupling_graph.h"
#include "lapwing/solve/dissection/separator.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// A set of nodes that is to be ordered. Unknowns weigh 1; nodes that only couple, 0; edges have no
/// weights.
struct Part {
  WeightedGraph graph;
  Groups groups;           ///< its nodes stand group by group
  std::vector<int> nodes;  ///< in the whole graph
  int first = 0;           ///< of its unknowns' places in the order
  int unknowns = 0;
};

Part whole_part(const CouplingGraph& graph);

/// What is left on `side` without the separator, and whatever couples it. Its `first` is not set.
Part side_of(const Part& part, const ThickSeparator& separator, int side);

}  // namespace lapwing::dissection
