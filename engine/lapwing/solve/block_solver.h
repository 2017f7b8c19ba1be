#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/progress.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// The matrix has no Cholesky factor: it is singular or indefinite at `block` (a block column in
/// the caller's numbering).
class NotPositiveDefinite : public SolverError {
 public:
  NotPositiveDefinite(const std::string& what, Index at) : SolverError(what), block(at) {}
  Index block;
};

/// What a factor is held and computed in. Matrices, right-hand sides and solutions are doubles.
enum class FactorPrecision {
  float64,  ///< refuses a pivot up to 1e-13 times its diagonal entry
  /// Half the memory. Refuses a pivot up to 1e-6 times its diagonal entry: solutions are right to
  /// some 1e-7 times the condition number, enough to precondition with.
  float32,
};

/// What `analyze` knows of the factorization to come; 0 where a solver does not say.
struct SolverStatistics {
  double flops = 0;              ///< operations of one factorization
  std::size_t factor_bytes = 0;  ///< memory of the factor
  std::size_t peak_bytes = 0;    ///< most memory that analysis, factor and solves hold together
};

/// What the symbolic factorization of a pattern has found. Does not change.
class SolverAnalysis {
 public:
  virtual ~SolverAnalysis() = default;
};

/// Sparse Cholesky factorization of a symmetric positive definite block matrix, in three steps
/// whose results are kept: analyze once per pattern, factor once per matrix, solve as often as
/// wanted. One object serves one thread at a time, but for solves: several threads may call those,
/// and wait for each other.
class BlockSolver {
 public:
  virtual ~BlockSolver() = default;

  /// "Lapwing block Cholesky", "CHOLMOD", "Eigen": for reports.
  virtual std::string_view name() const = 0;

  /// Symbolic factorization under `order` (new to old, from `fill_reducing_order`). The pattern
  /// must outlive the solver.
  virtual void analyze(const BlockPattern& pattern, int block_size, std::span<const int> order) = 0;

  /// What `analyze` has found, for others of the same class to share; null before, and of a class
  /// that cannot share it.
  virtual std::shared_ptr<const SolverAnalysis> analysis() const { return nullptr; }

  /// As the `analyze` that found this, which is not done again; its pattern must outlive this
  /// solver, too. Throws SolverError for what is not of this class.
  virtual void analyze_as(std::shared_ptr<const SolverAnalysis> analysis);

  /// Takes the memory of a factorization before it is wanted, and has the system clear it, which
  /// may take as long as the factorization: for another thread, beside what else there is to do.
  /// Throws Cancelled.
  virtual void prepare_memory() {}

  /// Numeric factorization of a matrix with the analyzed pattern. Throws NotPositiveDefinite.
  virtual void factor(const BlockMatrix& matrix) = 0;

  /// As `factor`, for a matrix that differs from the last one factored only in the diagonal blocks
  /// `changed` (block columns, in any order). A solver that can reuses the rest.
  virtual void refactor_diagonal(const BlockMatrix& matrix,
                                 [[maybe_unused]] std::span<const Index> changed) {
    factor(matrix);
  }

  /// Solves A X = B for `columns` right-hand sides stored one after the other, A.scalar_size()
  /// numbers each. B and X may be the same memory.
  virtual void solve(std::span<const double> B, std::span<double> X, std::size_t columns) = 0;

  /// As `solve`, in place, for right-hand sides in an order of the caller's: block b is block
  /// places[b] there. Cheapest near the order of elimination.
  virtual void solve_in_places(std::span<double> X, std::size_t columns,
                               std::span<const Index> places);

  virtual SolverStatistics statistics() const { return {}; }

  /// Has `factor` report stage "factor" on the calling thread, with the share of its operations
  /// done, and stop with Cancelled when `progress` says so. Stays until replaced. A solver that
  /// cannot stop half-way ignores it.
  void set_progress(Progress progress) { progress_ = std::move(progress); }

 protected:
  Progress progress_;
};

/// Our own multifrontal block Cholesky (block_cholesky/).
std::unique_ptr<BlockSolver> make_solver(FactorPrecision precision = FactorPrecision::float64);

}  // namespace lapwing
