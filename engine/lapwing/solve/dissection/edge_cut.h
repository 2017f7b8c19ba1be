#pragma once

#include <vector>

#include "lapwing/solve/dissection/moves.h"
#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// Each node's side, 0 or 1.
using Sides = std::vector<unsigned char>;

/// A graph in two, and how good that is with the weight of the edges between the sides for a
/// separator.
struct EdgeCut {
  CutScore score;
  Sides sides;
};

/// The cut of `graph` into `sides`, improved by one pass of moves across it.
EdgeCut improved_cut(const WeightedGraph& graph, Sides sides);

}  // namespace lapwing::dissection
