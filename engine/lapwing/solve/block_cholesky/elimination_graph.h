#pragma once

#include <span>
#include <vector>

#include "lapwing/solve/block_matrix.h"

namespace lapwing::cholesky {

/// The blocks of a pattern beside its diagonal, each with the one of its two columns that an order
/// eliminates first. Columns are numbered by their places in that order.
struct EliminationGraph {
  std::vector<int> places;  ///< of the pattern's columns
  std::vector<int> starts;
  /// Column j meets later[starts[j], starts[j+1]), which are eliminated after it ...
  std::vector<int> later;
  std::vector<int> blocks;  ///< ... in these blocks of the pattern

  int size() const { return static_cast<int>(places.size()); }
};

/// `order` is new to old. Throws SolverError where there are 2^31 blocks or more.
EliminationGraph elimination_graph(const BlockPattern& pattern, std::span<const int> order);

}  // namespace lapwing::cholesky
