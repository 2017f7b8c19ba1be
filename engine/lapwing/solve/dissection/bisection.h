#pragma once

#include <vector>

#include "lapwing/solve/dissection/weighted_graph.h"

namespace lapwing::dissection {

/// Each node's side, 0 or 1.
using Sides = std::vector<unsigned char>;

/// A graph cut in two: the edges between the sides weigh little, and neither side weighs more than
/// two thirds where nodes are light enough. Multilevel (Hendrickson, Leland 1995): the graph is
/// grouped until some hundred nodes are left; those are swept in the order of their distances from
/// nodes far apart, which on a body are the tips of its limbs; and the best sweeps are improved on
/// each level. The best of several `attempts`, which differ in how some thousand nodes are grouped;
/// `variant` numbers different ways to group more. Throws Cancelled.
Sides bisect(const WeightedGraph& graph, unsigned attempts, unsigned variant);

}  // namespace lapwing::dissection
