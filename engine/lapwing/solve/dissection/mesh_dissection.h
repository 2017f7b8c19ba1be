#pragma once

#include <vector>

namespace lapwing {

/// How the rows of M couple the unknowns of M'M. Node r is a row of M, which holds r and its
/// neighbours. Two unknowns are coupled in M'M if they are neighbours or share a neighbour, unknown
/// or not.
struct CouplingGraph {
  std::vector<int> starts{0};  ///< compressed rows; both rows of an edge hold it
  std::vector<int> neighbours;
  int unknowns = 0;  ///< nodes [0, unknowns); the others only couple

  int size() const { return static_cast<int>(starts.size()) - 1; }
};

/// Returns an order of the unknowns, new to old, that keeps the Cholesky factor of M'M sparse. It
/// is a nested dissection (George 1973) of the graph of the rows of M. A cut divides this graph,
/// and the unknowns at both ends of the cut edges come last in the order. Both sides are ordered
/// recursively; the unknowns already ordered take part only as nodes that couple others. Sets of up
/// to ninety unknowns are ordered by minimum degree. The order does not depend on the number of
/// threads. Throws Cancelled and std::bad_alloc.
std::vector<int> dissection_order(const CouplingGraph& graph);

}  // namespace lapwing
