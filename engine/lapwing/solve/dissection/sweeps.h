#pragma once

#include "lapwing/solve/dissection/edge_cut.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// Returns a cut of a small graph. Sweeps the nodes in the order of their distances from nodes far
/// apart (on a body, the tips of its limbs), and of the differences of two such distances. Improves
/// the best cut found.
EdgeCut best_sweep(const WeightedGraph& graph);

}  // namespace lapwing::dissection
