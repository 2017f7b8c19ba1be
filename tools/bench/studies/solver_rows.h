#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lapwing/solve/block_cholesky/block_cholesky.h"
#include "lapwing/solve/ordering.h"
#include "solvers/peer_solvers.h"

namespace lapwing::bench {

/// The systems to time solvers on: the RSI normal matrix M'M + W of a mesh, and its part for x
/// alone, which has the pattern and the size of the minimizer's n x n matrix.
struct BenchSystem {
  std::string name;
  BlockPattern pattern;
  BlockMatrix coupled;  ///< 3 x 3 blocks
  BlockMatrix scalar;   ///< 1 x 1 blocks
};

/// Median times in milliseconds; 0 if not measured.
struct SolverRow {
  std::string name;
  double order = 0;
  double analyze = 0;
  double first_factor = 0;  ///< with new memory, as in the first preparation of a region
  double factor = 0;
  double one_diagonal = 0;  ///< refactorization after a change in one diagonal block
  double one_column = 0;
  double twelve_columns = 0;
  double scalar_factor = 0;
  double error = 0;  ///< normwise backward error of the single right-hand side

  double cold() const { return order + analyze + first_factor; }
};

/// Times the solvers that `make` creates, through the BlockSolver interface.
SolverRow time_solver(const BenchSystem& system, const std::string& name,
                      const std::function<std::unique_ptr<BlockSolver>()>& make, Ordering ordering,
                      int repeats);

/// Returns `count` numbers between -1 and 1, the same each time.
std::vector<double> right_hand_sides(std::size_t count);

/// Returns |A x - b| / (|A| |x| + |b|) in the maximum norm.
double normwise_backward_error(const BlockMatrix& A, std::span<const double> x,
                               std::span<const double> b);

#ifdef LAPWING_HAVE_CHOLMOD
/// Times CHOLMOD's supernodal factorization and its solve with reused work space, on 1 and on 2
/// BLAS threads. Each time is the better of the two.
SolverRow time_cholmod(const BenchSystem& system, CholmodOrdering ordering, int repeats);
#endif

}  // namespace lapwing::bench
