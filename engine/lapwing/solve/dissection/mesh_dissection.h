#pragma once

#include <vector>

#include "lapwing/solve/dissection/coupling_graph.h"

namespace lapwing {

/// An order of the unknowns, new to old, that keeps the Cholesky factor of M'M sparse: nested
/// dissection (George 1973) of the rows of M, whose graph has a third of the edges of M'M's.
///
/// A set of nodes is cut in two; the unknowns at both ends of the cut edges come last, and the two
/// sides, with those unknowns as nodes that only couple, are ordered in the same way, until some
/// ninety unknowns are left, which minimum degree orders. All threads take sets where they find
/// them. The same graph gives the same order, whatever their number.
///
/// Throws Cancelled, and SolverError where memory ends.
std::vector<int> dissection_order(const CouplingGraph& graph);

}  // namespace lapwing
