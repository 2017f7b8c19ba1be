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

}  // namespace lapwing
