#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing {

/// Thrown if the matrix has no Cholesky factor because it is singular or indefinite. The failing
/// pivot is in block column `block`, in the caller's numbering.
class NotPositiveDefinite : public SolverError {
 public:
  NotPositiveDefinite(const std::string& what, Index at) : SolverError(what), block(at) {}
  Index block;
};

/// The number type of a factor. Matrices, right-hand sides and solutions are always doubles.
enum class FactorPrecision {
  float64,  ///< rejects pivots of at most 1e-13 times the diagonal entry
  /// Half the memory. Rejects pivots of at most 1e-6 times the diagonal entry. The relative error
  /// of a solution is about 1e-7 times the condition number, which suffices for a preconditioner.
  float32,
};

/// Predictions of `analyze` for the factorization. Values that a solver cannot predict are 0.
struct SolverStatistics {
  double flops = 0;  ///< operations of one factorization
  std::size_t factor_bytes = 0;
  std::size_t peak_bytes = 0;  ///< peak memory of analysis, factor and solves together
};

/// The immutable result of the symbolic factorization of a pattern.
class SolverAnalysis {
 public:
  virtual ~SolverAnalysis() = default;
};

/// Sparse Cholesky factorization of a symmetric positive definite block matrix, in three steps:
/// analyze once per pattern, factorize once per matrix, solve as often as needed. Only the solve
/// functions may be called from several threads at once; a mutex serializes them.
class BlockSolver {
 public:
  virtual ~BlockSolver() = default;

  /// Name for reports, such as "CHOLMOD".
  virtual std::string_view name() const = 0;

  /// Computes the symbolic factorization under `order` (new to old, from `fill_reducing_order`).
  /// The pattern must outlive the solver.
  virtual void analyze(const BlockPattern& pattern, int block_size, std::span<const int> order) = 0;

  /// Returns the result of `analyze`, which other solvers of the same class can share. Returns null
  /// before `analyze`, or if the class does not support sharing.
  virtual std::shared_ptr<const SolverAnalysis> analysis() const { return nullptr; }

  /// Uses a shared analysis instead of `analyze`. Its pattern must also outlive this solver. Throws
  /// SolverError if the analysis is not of this class.
  virtual void analyze_as(std::shared_ptr<const SolverAnalysis> analysis);

  /// Allocates the memory of a factorization in advance, and touches it so that the system clears
  /// its pages. This may take as long as the factorization itself; call it on a background thread.
  /// Throws Cancelled.
  virtual void prepare_memory() {}

  /// Factorizes a matrix with the analyzed pattern. Throws NotPositiveDefinite.
  virtual void factorize(const BlockMatrix& matrix) = 0;

  /// Like `factorize`, for a matrix that differs from the last factorized matrix only in the
  /// diagonal blocks `changed` (block columns, in any order). A solver may reuse the unchanged
  /// parts of the factor.
  virtual void refactorize_diagonal(const BlockMatrix& matrix,
                                    [[maybe_unused]] std::span<const Index> changed) {
    factorize(matrix);
  }

  /// Solves A X = B for `columns` right-hand sides, which are stored one after the other with
  /// A.scalar_size() numbers each. B and X may be the same memory.
  virtual void solve(std::span<const double> B, std::span<double> X, std::size_t columns) = 0;

  /// Solves A X = B in place, where X initially contains B. Block b of the matrix corresponds to
  /// block places[b] of X. Fastest if X is stored nearly in elimination order.
  virtual void solve_in_places(std::span<double> X, std::size_t columns,
                               std::span<const Index> places);

  virtual SolverStatistics statistics() const { return {}; }

  /// Sets the callback to which `factorize` reports the stage "factor" and the completed fraction
  /// of its operations, on the calling thread. If the callback returns false, `factorize` throws
  /// Cancelled. Solvers that cannot be interrupted ignore the callback.
  void set_progress(Progress progress) { progress_ = std::move(progress); }

 protected:
  Progress progress_;
};

/// Creates the engine's own multifrontal block Cholesky solver (block_cholesky/).
std::unique_ptr<BlockSolver> make_solver(FactorPrecision precision = FactorPrecision::float64);

}  // namespace lapwing
