#pragma once

#include <cstddef>
#include <cstdint>

namespace lapwing::cholesky {

// The functions of this header have internal linkage because the kernels are compiled once per
// instruction set. Otherwise the linker could use a copy compiled for AVX-512 in the baseline code.

/// Number of rows in a strip. A strip is stored in column-major order, so one column of doubles
/// fills one AVX-512 register or two AVX2 registers. Zero rows pad the row counts to whole strips.
inline constexpr int kStrip = 8;

/// Returns the number of strips that are needed for `rows` rows.
static inline int strips_of(int rows) {
  return (rows + kStrip - 1) / kStrip;
}

/// Returns the offset of strip s in a lower triangle of strips, in which strip s has 8 (s + 1)
/// columns.
static inline std::size_t triangle_offset(int s) {
  return static_cast<std::size_t>(s) * (static_cast<std::size_t>(s) + 1) * (kStrip * kStrip / 2);
}

/// The `pivots` columns of the factor that one front computes. The panel stores the pivot rows
/// first (a lower triangle of strips; the last one has `pivots` columns), then the update rows
/// (strips of `pivots` columns). Pivot rows and update rows are padded separately. Diagonal entries
/// are stored as 1 / l_jj. Entries above the diagonal inside a tile are 0.
template <typename Real>
struct FrontView {
  Real* panel = nullptr;
  int pivots = 0;
  int pivot_strips = 0;
  int update_strips = 0;
};

static inline std::size_t pivot_part_size(int pivots, int pivot_strips) {
  if (pivots == 0) return 0;
  return triangle_offset(pivot_strips - 1) + static_cast<std::size_t>(kStrip) * pivots;
}

/// Returns a pointer to the first entry of strip s. Update strips are numbered after the pivot
/// strips.
template <typename Real>
static inline Real* strip_at(const FrontView<Real>& front, int s) {
  if (s < front.pivot_strips) return front.panel + triangle_offset(s);
  return front.panel + pivot_part_size(front.pivots, front.pivot_strips) +
         static_cast<std::size_t>(s - front.pivot_strips) * kStrip * front.pivots;
}

/// Consecutive rows of a child's update matrix that are also consecutive in the parent. Lanes
/// [first, last) of strip `source` map to lanes [first + shift, last + shift) of the parent's strip
/// `target`.
struct Piece {
  std::int32_t source = 0;
  std::int32_t target = 0;
  std::int8_t first = 0;
  std::int8_t last = 0;
  std::int8_t shift = 0;
};

/// A child's update matrix (a lower triangle of strips), to be added to its parent.
template <typename Real>
struct ChildUpdate {
  const Real* matrix = nullptr;
  const int* position = nullptr;  ///< padded row in the parent for each update row
  int pivot_columns = 0;          ///< number of leading rows that are pivots of the parent
  int updates = 0;
  const Piece* pieces_begin = nullptr;
  const Piece* pieces_end = nullptr;  ///< ascending in both source and target
};

/// Vector loads may read up to this many numbers before or after a child's update matrix.
inline constexpr std::size_t kUpdateSlack = kStrip;

}  // namespace lapwing::cholesky
