#pragma once

#include <vector>

#include "lapwing/solve/dissection/coupling_graph.h"

namespace lapwing {

/// Returns an order of the unknowns, new to old, that keeps the Cholesky factor of M'M sparse. This
/// is nested dissection (George 1973) of the graph of the rows of M, which has a third of the edges
/// of that of M'M.
///
/// A set of nodes is cut in two. The unknowns at both ends of the cut edges come last. The two
/// sides, with those unknowns as nodes that only couple, are ordered in the same way. Minimum
/// degree orders sets of up to ninety unknowns. All threads share the sets, and the order does not
/// depend on their number.
///
/// Throws Cancelled, and std::bad_alloc if memory runs out.
std::vector<int> dissection_order(const CouplingGraph& graph);

}  // namespace lapwing
