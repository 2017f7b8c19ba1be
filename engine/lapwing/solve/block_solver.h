#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// The matrix has no Cholesky factor: it is singular or indefinite at `block` (a block column in
/// the caller's numbering).
class NotPositiveDefinite : public SolverError {
 public:
  NotPositiveDefinite(const std::string& what, Index at) : SolverError(what), block(at) {}
  Index block;
};

/// The number type of a factor. Matrices, right-hand sides and solutions are always doubles.
enum class FactorPrecision {
  float64,  ///< refuses a pivot up to 1e-13 times its diagonal entry
  /// Half the memory. Refuses a pivot up to 1e-6 times its diagonal entry. The relative error of a
  /// solution is about 1e-7 times the condition number, which suffices for a preconditioner.
  float32,
};

/// Predictions of `analyze` for the factorization. A number that a solver does not know is 0.
struct SolverStatistics {
  double flops = 0;              ///< operations of one factorization
  std::size_t factor_bytes = 0;  ///< memory of the factor
  std::size_t peak_bytes = 0;    ///< peak memory of analysis, factor and solves together
};

/// The immutable result of the symbolic factorization of a pattern.
class SolverAnalysis {
 public:
  virtual ~SolverAnalysis() = default;
};

/// Sparse Cholesky factorization of a symmetric positive definite block matrix, in three steps:
/// analyze once per pattern, factor once per matrix, solve as often as needed. Only the solves may
/// be called from several threads at once; they wait for each other.
class BlockSolver {
 public:
  virtual ~BlockSolver() = default;

  /// Name for reports, such as "CHOLMOD".
  virtual std::string_view name() const = 0;

  /// Computes the symbolic factorization under `order` (new to old, from `fill_reducing_order`).
  /// The pattern must outlive the solver.
  virtual void analyze(const BlockPattern& pattern, int block_size, std::span<const int> order) = 0;

  /// Returns the result of `analyze`, for other solvers of the same class to share. Null before
  /// `analyze`, or if the class cannot share it.
  virtual std::shared_ptr<const SolverAnalysis> analysis() const { return nullptr; }

  /// Uses a shared analysis instead of `analyze`. Its pattern must outlive this solver too. Throws
  /// SolverError if the analysis is not of this class.
  virtual void analyze_as(std::shared_ptr<const SolverAnalysis> analysis);

  /// Allocates the memory of a factorization in advance and lets the system clear it. This may take
  /// as long as the factorization, and is meant for a background thread. Throws Cancelled.
  virtual void prepare_memory() {}

  /// Factorizes a matrix with the analyzed pattern. Throws NotPositiveDefinite.
  virtual void factorize(const BlockMatrix& matrix) = 0;

  /// Like `factor`, for a matrix that differs from the last one factored only in the diagonal
  /// blocks `changed` (block columns, in any order). A solver may reuse the rest.
  virtual void refactorize_diagonal(const BlockMatrix& matrix,
                                    [[maybe_unused]] std::span<const Index> changed) {
    factorize(matrix);
  }

  /// Solves A X = B for `columns` right-hand sides stored one after the other, A.scalar_size()
  /// numbers each. B and X may be the same memory.
  virtual void solve(std::span<const double> B, std::span<double> X, std::size_t columns) = 0;

  /// Like `solve`, in place, for right-hand sides in the caller's order: block b of the matrix is
  /// block places[b] of X. Fastest if that order is close to the order of elimination.
  virtual void solve_in_places(std::span<double> X, std::size_t columns,
                               std::span<const Index> places);

  virtual SolverStatistics statistics() const { return {}; }

  /// Sets the callback to which `factor` reports stage "factor" and the share of its operations
  /// done, on the calling thread. If `progress` says so, `factor` throws Cancelled. Stays until
  /// replaced. A solver that cannot stop half-way ignores it.
  void set_progress(Progress progress) { progress_ = std::move(progress); }

 protected:
  Progress progress_;
};

/// Returns the engine's own multifrontal block Cholesky solver (block_cholesky/).
std::unique_ptr<BlockSolver> make_solver(FactorPrecision precision = FactorPrecision::float64);

}  // namespace lapwing
