#pragma once

#include <vector>

namespace lapwing {

/// What couples the unknowns of M'M, from the rows of M: node r is a row, and its row holds it and
/// its neighbours. Two unknowns meet in M'M when they are neighbours or have one in common, be that
/// an unknown or not.
struct CouplingGraph {
  std::vector<int> starts{0};  ///< in compressed rows: every edge stands in both of its rows
  std::vector<int> neighbours;
  int unknowns = 0;  ///< nodes [0, unknowns); the others only couple

  int size() const { return static_cast<int>(starts.size()) - 1; }
};

}  // namespace lapwing
