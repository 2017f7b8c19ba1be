#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lapwing/solve/block_cholesky/arena.h"
#include "lapwing/solve/block_cholesky/numeric.h"

namespace lapwing::cholesky {

/// Forward and backward substitution with a factor, front by front. As in the factorization, a
/// front passes its contribution to the update rows to its parent, so two threads never write the
/// same number. Right-hand sides and solutions are doubles in both precisions.
template <typename Real>
class TriangularSolve {
 public:
  TriangularSolve(const Symbolic& symbolic, const Numeric<Real>& numeric,
                  const KernelTable<Real>& kernels, WorkerPool& pool);

  /// Returns the number of bytes that `solve` needs with `threads` threads and kWidestSolve
  /// right-hand sides at once.
  static std::size_t bytes_needed(const Symbolic& symbolic, int threads);

  /// Solves A X = B for `columns` right-hand sides, which are stored one after the other. B and X
  /// may be the same memory. Block b of the matrix corresponds to block places[b] of B and X, or to
  /// block b if `places` is empty.
  void solve(std::span<const double> B, std::span<double> X, std::size_t columns,
             std::span<const Index> places);

 private:
  class Forward;
  class Backward;

  // The columns of B and X that are being solved.
  struct Columns {
    const double* B = nullptr;
    double* X = nullptr;
    int count = 0;
    std::span<const Index> places;
    std::array<double, kWidestSolve> scales = {};  // scale of each column, used for floats
  };

  void solve_columns(Columns columns);
  void reserve(int width);
  Real* update_rows(const Front& front, int thread) const;
  Real* own_rows(const Front& front) const;
  template <typename Body>
  void for_pivot_blocks(const Front& front, const Body& body) const;
  void load_pivots(const Front& front, Real* y) const;
  void store_pivots(const Front& front, const Real* y) const;
  int chunks_for(const Front& front, int pieces) const;

  const Symbolic& symbolic_;
  const Numeric<Real>& numeric_;
  const KernelTable<Real>& kernels_;
  WorkerPool& pool_;
  SharedWork upward_;
  SharedWork downward_;
  std::size_t most_pivots_ = 0;  // largest padded number of pivots of a front
  std::size_t most_updates_ = 0;
  int width_ = 0;  // right-hand sides per row
  const SolveKernels<Real>* solve_ = nullptr;
  Columns columns_;
  Arena<Real> solution_;             // all rows, in elimination order
  Arena<Real> kept_;                 // update rows of the fronts with keeps_update
  std::vector<Arena<Real>> stacks_;  // update rows of all other fronts; one stack per thread
  std::vector<Arena<Real>>
      scratch_;  // pivot rows, update rows, and 8 numbers per pivot; one per thread
};

}  // namespace lapwing::cholesky
