#pragma once

#include <limits>
#include <type_traits>

#include "lapwing/base/instruction_set.h"
#include "lapwing/solve/block_cholesky/front_layout.h"

namespace lapwing::cholesky {

/// Numbers of right-hand sides for which solve kernels exist, ascending.
inline constexpr int kSolveWidths[] = {1, 4, 8, 12};
inline constexpr int kWidestSolve = 12;

/// Triangular solves with one front for a fixed number R of right-hand sides. Vectors store R
/// numbers per row. `y` has one row per padded pivot row, `w` one per padded update row. Padding
/// rows are 0.
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
  /// y = L11^-T y. `scratch` has space for 8 numbers per pivot.
  void (*backward_pivots)(const FrontView<Real>& front, Real* y, Real* scratch);
};

/// The integer type with the size of Real, used for masks.
template <typename Real>
using Lane = std::conditional_t<sizeof(Real) == sizeof(long long), long long, int>;

/// The inner loops, compiled once per instruction set and number type from factor_kernels.inl and
/// solve_kernels.inl. The order of operations on each entry depends only on the front. Results are
/// therefore bitwise identical however the strips are divided between calls.
template <typename Real>
struct KernelTable {
  /// Factorizes the pivot strips [first, last) of a panel. All columns before strip `first` must
  /// already be computed, also within these strips. Returns the first pivot that is not finite or
  /// not greater than its entry of `floor` (one number per pivot of the front), or -1.
  int (*factor_pivots)(const FrontView<Real>& front, int first, int last, const Real* floor);
  /// Computes the entries of the factor in the rows of strips [first, last) and the columns of
  /// pivot strips [first_column, last_column). The rows must be below these pivot strips.
  void (*solve_rows)(const FrontView<Real>& front, int first, int last, int first_column,
                     int last_column);
  /// Writes strips [first, last) of the update matrix -L21 L21'.
  void (*update)(const FrontView<Real>& front, Real* matrix, int first, int last);
  /// Adds a child's pieces to the pivot columns of the panel.
  void (*add_to_panel)(const ChildUpdate<Real>& child, const FrontView<Real>& front);
  /// Adds a child's pieces to the update matrix.
  void (*add_to_update)(const ChildUpdate<Real>& child, const FrontView<Real>& front, Real* matrix);
  SolveKernels<Real> solve[4];  ///< one for each entry of kSolveWidths
};

struct KernelTables {
  KernelTable<double> doubles;
  KernelTable<float> floats;
};

/// Returns the kernels of an instruction set; for `automatic`, those of the fastest set that the
/// CPU supports. Throws SolverError if the CPU or this build does not support the set.
const KernelTables& kernels_for(InstructionSet set);

}  // namespace lapwing::cholesky
