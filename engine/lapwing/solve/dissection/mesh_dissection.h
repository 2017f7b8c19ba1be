#pragma once

#include <vector>

namespace lapwing {

/// The graph of the rows of M, which determines the couplings of M'M. Node r is row r of M, whose
/// nonzero columns are r and its neighbours. Two unknowns are coupled in M'M if they are neighbours
/// or have a common neighbour, which need not be an unknown.
struct CouplingGraph {
  std::vector<int> starts{0};  ///< compressed rows; each edge is stored in the rows of both ends
  std::vector<int> neighbours;
  int unknowns = 0;  ///< nodes [0, unknowns) are unknowns; the others only couple unknowns

  int size() const { return static_cast<int>(starts.size()) - 1; }
};

/// Returns an order of the unknowns, new to old, that keeps the Cholesky factor of M'M sparse. It
/// is a nested dissection (George 1973) of the graph of the rows of M. A cut divides this graph,
/// and the unknowns at both ends of the cut edges come last in the order. Both sides are ordered
/// recursively. In the recursion, unknowns that are already ordered only couple other unknowns.
/// Sets of up to ninety unknowns are ordered by minimum degree. The order does not depend on the
/// number of threads. Throws Cancelled and std::bad_alloc.
std::vector<int> dissection_order(const CouplingGraph& graph);

}  // namespace lapwing
