#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// The Cholesky factor of A + diag(W), where A is the normal matrix of a region and W the
/// constraint stiffness of each unknown. After the analysis, A and W may change at any time;
/// `factorize` then recomputes only the parts that depend on the change. Only one thread may use an
/// object at a time, except for `analyze`.
class ConstrainedFactor {
 public:
  /// `block_size` is 3 for M'M and 1 for L'L. `pattern` must outlive the object.
  ConstrainedFactor(const SystemPattern& pattern, int block_size,
                    FactorPrecision precision = FactorPrecision::float64);

  /// Computes the order and the symbolic factorization, which do not need A. May run at the same
  /// time as `set_matrix`. Later calls do nothing.
  void analyze();
  /// Like `analyze` above, with the elimination order `order` (new to old).
  void analyze(std::span<const int> order);
  /// Shares the analysis of another factor with the same pattern and block size.
  void analyze_as(const ConstrainedFactor& other);
  bool is_analyzed() const { return analyzed_; }

  void set_matrix(BlockMatrix A);
  /// Returns the last factorized matrix A + diag(W).
  const BlockMatrix& matrix() const { return A_; }
  /// Returns the matrix A of the last call of `set_matrix`.
  BlockMatrix unconstrained_matrix() const;
  /// Returns the diagonal of A, one number per scalar unknown.
  std::span<const double> unconstrained_diagonal() const { return diagonal_; }
  /// Returns the memory of A, which the next matrix can use. This object then has no matrix.
  Numbers take_memory();

  /// Returns true if the current factor is that of A + diag(W).
  bool is_factorized_for(std::span<const double> W) const;

  /// Factorizes A + diag(W). Call `analyze` and `set_matrix` first. Does nothing if this factor is
  /// already computed. If only W has changed, recomputes only the parts that depend on the change;
  /// the result is bitwise identical. Throws NotPositiveDefinite or Cancelled. After an exception,
  /// analysis and A remain valid, but not the factor.
  void factorize(std::span<const double> W, const Progress& progress = {});

  BlockSolver& solver() const { return *solver_; }

 private:
  void hold(std::size_t unknown, double weight);

  const SystemPattern& pattern_;
  int block_size_;
  std::unique_ptr<BlockSolver> solver_;
  bool analyzed_ = false;
  bool factored_ = false;         ///< true if the current factor is that of A_
  BlockMatrix A_;                 ///< A + diag(W_)
  std::vector<double> diagonal_;  ///< diagonal of A without W, one number per scalar unknown
  std::vector<double> W_;
};

}  // namespace lapwing
