#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// The Cholesky factor of A + diag(W): a region's normal matrix A and, per unknown, how firmly it
/// is held. Analyzed once; after that A and W may change as often as wanted, and `factor` redoes
/// what depends on what did. One thread at a time, `analyze` excepted.
class ConstrainedFactor {
 public:
  /// Of matrices in blocks of `block_size`, 3 for M'M or 1 for L'L. `pattern` must outlive the
  /// object.
  ConstrainedFactor(const SystemPattern& pattern, int block_size,
                    FactorPrecision precision = FactorPrecision::float64);

  /// The symbolic work, the order included, which needs no numbers; may run beside `set_matrix`.
  /// Does nothing when done already.
  void analyze();
  /// The same in an order of one's own, new to old.
  void analyze(std::span<const int> order);
  /// The same, as another one of the same pattern and block size has done it.
  void analyze_as(const ConstrainedFactor& other);
  bool is_analyzed() const { return analyzed_; }

  /// A, without W.
  void set_matrix(BlockMatrix A);
  /// A + diag(W) as factored last.
  const BlockMatrix& matrix() const { return A_; }
  /// A as set last.
  BlockMatrix unconstrained_matrix() const;
  /// What the last A lay in, for the next. There is no A then.
  Numbers take_memory();

  /// Whether A + diag(W) is what is factored.
  bool holds(std::span<const double> W) const;

  /// Factors A + diag(W), after the two above; does nothing when that is factored already. Where
  /// only W differs from the last time it keeps the parts of the factor that no changed number
  /// reaches. Same bits either way. Throws NotPositiveDefinite, Cancelled: analysis and A are then
  /// kept, the factor is not.
  void factor(std::span<const double> W, const Progress& progress = {});

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
