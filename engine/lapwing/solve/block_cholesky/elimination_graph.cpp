#include "lapwing/solve/block_cholesky/elimination_graph.h"

#include <algorithm>
#include <limits>
#include <string>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing::cholesky {
namespace {

// Calls visit(first, later, block) for every off-diagonal block.
template <typename Visit>
void for_each_block(const BlockPattern& pattern, const std::vector<int>& places, Visit visit) {
  CancelCheck check;
  for (std::size_t c = 0; c < pattern.size(); ++c) {
    check();
    const int column = places[c];
    for (std::size_t e = pattern.starts[c] + 1; e < pattern.starts[c + 1]; ++e) {
      const int row = places[pattern.rows[e]];
      visit(std::min(row, column), std::max(row, column), static_cast<int>(e));
    }
  }
}

}  // namespace

EliminationGraph elimination_graph(const BlockPattern& pattern, std::span<const int> order) {
  if (pattern.rows.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw SolverError("the system has " + std::to_string(pattern.rows.size()) +
                      " blocks, more than the factorization can index; choose a smaller region");
  }
  EliminationGraph graph;
  graph.places.resize(order.size());
  for (std::size_t j = 0; j < order.size(); ++j) graph.places[order[j]] = static_cast<int>(j);
  graph.starts.assign(order.size() + 1, 0);
  for_each_block(pattern, graph.places, [&](int first, int, int) { ++graph.starts[first + 1]; });
  for (std::size_t j = 0; j < order.size(); ++j) graph.starts[j + 1] += graph.starts[j];
  graph.later.resize(static_cast<std::size_t>(graph.starts.back()));
  graph.blocks.resize(graph.later.size());
  std::vector<int> next(graph.starts.begin(), graph.starts.end() - 1);
  for_each_block(pattern, graph.places, [&](int first, int later, int block) {
    const int at = next[first]++;
    graph.later[at] = later;
    graph.blocks[at] = block;
  });
  return graph;
}

}  // namespace lapwing::cholesky
