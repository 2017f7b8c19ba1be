#include "lapwing/solve/block_solver.h"

#include <algorithm>
#include <vector>

namespace lapwing {

void BlockSolver::analyze_as(std::shared_ptr<const SolverAnalysis> /*analysis*/) {
  throw SolverError("this solver cannot use the analysis of another solver; call analyze");
}

void BlockSolver::solve_in_places(std::span<double> X, std::size_t columns,
                                  std::span<const Index> places) {
  if (X.empty()) return;
  const std::size_t blocks = places.size();
  const std::size_t b = X.size() / (columns * blocks);
  std::vector<double> own(X.size());
  const auto for_blocks = [&](const auto& body) {
    for (std::size_t r = 0; r < columns; ++r) {
      for (std::size_t k = 0; k < blocks; ++k) {
        body(own.data() + (r * blocks + k) * b, X.data() + (r * blocks + places[k]) * b);
      }
    }
  };
  for_blocks([&](double* to, const double* from) { std::copy_n(from, b, to); });
  solve(own, own, columns);
  for_blocks([&](const double* from, double* to) { std::copy_n(from, b, to); });
}

}  // namespace lapwing
