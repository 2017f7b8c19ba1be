#pragma once

#include <limits>
#include <type_traits>

#include "lapwing/base/instruction_set.h"
#include "lapwing/solve/block_cholesky/front_layout.h"

namespace lapwing::cholesky {

/// Numbers of right-hand sides that a solve can take at once, ascending.
inline constexpr int kSolveWidths[] = {1, 4, 8, 12};
inline constexpr int kWidestSolve = 12;

/// Triangular solves with one front for a fixed number R of right-hand sides. Vectors hold R
/// numbers per row. y has a row for each padded pivot row, w for each padded update row. Padding is
/// 0.
template <typename Real>
struct SolveKernels {
  /// y = L11^-1 y.
  void (*forward_pivots)(const FrontView<Real>& front, Real* y);
  /// w -= L21 y, for the rows of update strips [first, last).
  void (*forward_updates)(const FrontView<Real>& front, const Real* y, Real* w, int first,
                          int last);
  /// y -= L21' w, for the pivots [first, last).
  void (*backward_updates)(const FrontView<Real>& front, const Real* w, Real* y, int first,
                           int last);
  /// y = L11^-T y. `scratch` has 8 numbers for each pivot.
  void (*backward_pivots)(const FrontView<Real>& front, Real* y, Real* scratch);
};

/// The integer type of the size of Real, for masks.
template <typename Real>
using Lane = std::conditional_t<sizeof(Real) == sizeof(long long), long long, int>;

/// The inner loops, compiled once per instruction set and number type from factor_kernels.inl and
/// solve_kernels.inl. The front alone fixes the order of operations on every number: how strips are
/// divided between calls does not change a bit.
template <typename Real>
struct KernelTable {
  /// Factorizes the pivot strips [first, last) of a panel whose columns before them are done (in
  /// these strips too). A pivot must be finite and above its `floor` (one number per pivot of the
  /// front). Returns the first pivot that is not, or -1.
  int (*factor_pivots)(const FrontView<Real>& front, int first, int last, const Real* floor);
  /// Computes the factor's rows of strips [first, last), which lie below pivot strip
  /// last_column - 1, in the columns of pivot strips [first_column, last_column).
  void (*solve_rows)(const FrontView<Real>& front, int first, int last, int first_column,
                     int last_column);
  /// Writes strips [first, last) of the update matrix -L21 L21'.
  void (*update)(const FrontView<Real>& front, Real* matrix, int first, int last);
  /// Adds a child's pieces to the pivot columns of the panel.
  void (*add_to_panel)(const ChildUpdate<Real>& child, const FrontView<Real>& front);
  /// Adds a child's pieces to the update matrix.
  void (*add_to_update)(const ChildUpdate<Real>& child, const FrontView<Real>& front, Real* matrix);
  SolveKernels<Real> solve[4];  ///< for each of kSolveWidths
};

/// The kernels of one instruction set.
struct KernelTables {
  KernelTable<double> doubles;
  KernelTable<float> floats;
};

/// Returns the kernels of an instruction set; for `automatic`, of the fastest one of this
/// processor. Throws SolverError if the processor or this build lacks the set.
const KernelTables& kernels_for(InstructionSet set);

}  // namespace lapwing::cholesky
