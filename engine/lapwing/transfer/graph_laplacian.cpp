#include "lapwing/transfer/graph_laplacian.h"

#include <algorithm>
#include <tuple>

#include "lapwing/solve/ordering.h"

namespace lapwing {

GraphLaplacian::GraphLaplacian(std::vector<WeightedEdge> edges, std::span<const double> held)
    : pattern_(std::make_unique<BlockPattern>()), solver_(make_solver()) {
  std::ranges::sort(edges, {}, [](const WeightedEdge& e) { return std::tuple(e.i, e.j); });
  std::vector<double> diagonal(held.begin(), held.end());
  for (const WeightedEdge& e : edges) {
    diagonal[e.i] += e.weight;
    diagonal[e.j] += e.weight;
  }
  BlockMatrix A{pattern_.get(), 1, {}};
  auto edge = edges.begin();
  for (Index c = 0; c < held.size(); ++c) {
    pattern_->rows.push_back(c);
    A.values.push_back(diagonal[c]);
    for (; edge != edges.end() && edge->i == c; ++edge) {
      pattern_->rows.push_back(edge->j);
      A.values.push_back(-edge->weight);
    }
    pattern_->starts.push_back(pattern_->rows.size());
  }
  solver_->analyze(*pattern_, 1, fill_reducing_order(*pattern_));
  solver_->factorize(A);
}

void GraphLaplacian::solve(std::span<double> X, std::size_t columns) const {
  solver_->solve(X, X, columns);
}

}  // namespace lapwing
