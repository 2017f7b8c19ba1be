#pragma once

#include "lapwing/solve/dissection/edge_cut.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// A cut of a small graph: its nodes are swept in the order of their distances from nodes far
/// apart, which on a body are the tips of its limbs, and of the differences of two such distances.
/// The best of the cuts on the way, improved.
EdgeCut best_sweep(const WeightedGraph& graph);

}  // namespace lapwing::dissection
