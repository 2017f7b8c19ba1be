#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/solve/block_solver.h"

namespace lapwing {

struct WeightedEdge {
  Index i = 0;
  Index j = 0;  ///< greater than i
  double weight = 1.0;
};

/// The factor of the Laplacian of a weighted graph plus a diagonal,
///     (A x)_i = sum_j w_ij (x_i - x_j) + held_i x_i.
class GraphLaplacian {
 public:
  /// `held` has one number per vertex. Each connected component of the graph must contain a vertex
  /// whose number is positive. Throws NotPositiveDefinite.
  GraphLaplacian(std::vector<WeightedEdge> edges, std::span<const double> held);

  /// Solves A X = B in place. X contains `columns` vectors, one after the other. Threads may share
  /// an object.
  void solve(std::span<double> X, std::size_t columns) const;

 private:
  std::unique_ptr<BlockPattern> pattern_;  // the solver refers to it
  std::unique_ptr<BlockSolver> solver_;
};

}  // namespace lapwing
