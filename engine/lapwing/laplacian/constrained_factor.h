#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// The Cholesky factor of A + diag(W), with A a region's normal matrix and W the stiffness that
/// holds each unknown. After one analysis, A and W may change at any time, and `factor` redoes what
/// depends on the change. For one thread at a time, except `analyze`.
class ConstrainedFactor {
 public:
  /// For matrices in blocks of `block_size`, 3 for M'M or 1 for L'L. `pattern` must outlive the
  /// object.
  ConstrainedFactor(const SystemPattern& pattern, int block_size,
                    FactorPrecision precision = FactorPrecision::float64);

  /// Computes the order and the symbolic factorization, which need no values. May run at the same
  /// time as `set_matrix`. Does nothing if already done.
  void analyze();
  /// The same in an order of the caller's, new to old.
  void analyze(std::span<const int> order);
  /// Takes over the analysis of another factor with the same pattern and block size.
  void analyze_as(const ConstrainedFactor& other);
  bool is_analyzed() const { return analyzed_; }

  /// Sets A, without W.
  void set_matrix(BlockMatrix A);
  /// Returns A + diag(W) as factored last.
  const BlockMatrix& matrix() const { return A_; }
  /// Returns A as set last.
  BlockMatrix unconstrained_matrix() const;
  /// Returns the diagonal of A, one number per scalar unknown.
  std::span<const double> unconstrained_diagonal() const { return diagonal_; }
  /// Returns the memory of A for use by the next matrix. This object then has no A.
  Numbers take_memory();

  /// Returns true if the current factor is that of A + diag(W).
  bool is_factorized_for(std::span<const double> W) const;

  /// Factorizes A + diag(W), after `analyze` and `set_matrix`. Does nothing if that is the current
  /// factor. If only W has changed, recomputes only what depends on the change; the result is
  /// bitwise identical. Throws NotPositiveDefinite or Cancelled. After an exception, analysis and A
  /// remain valid, but not the factor.
  void factorize(std::span<const double> W, const Progress& progress = {});

  BlockSolver& solver() const { return *solver_; }

 private:
  void hold(std::size_t unknown, double weight);

  const SystemPattern& pattern_;
  int block_size_;
  std::unique_ptr<BlockSolver> solver_;
  bool analyzed_ = false;
  bool factored_ = false;         ///< A_, which holds W_
  BlockMatrix A_;                 ///< with W_ added
  std::vector<double> diagonal_;  ///< of A without W, a number for each scalar unknown
  std::vector<double> W_;
};

}  // namespace lapwing
