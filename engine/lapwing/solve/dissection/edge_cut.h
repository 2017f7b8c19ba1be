#pragma once

#include <vector>

#include "lapwing/solve/dissection/moves.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// Each node's side, 0 or 1.
using Sides = std::vector<unsigned char>;

/// A cut of a graph in two. For its score, the weight of the cut edges stands for the separator.
struct EdgeCut {
  CutScore score;
  Sides sides;
};

/// Returns the cut of `graph` into `sides`, improved by one pass of moves.
EdgeCut improved_cut(const WeightedGraph& graph, Sides sides);

}  // namespace lapwing::dissection
