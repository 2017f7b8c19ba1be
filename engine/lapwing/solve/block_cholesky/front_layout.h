#pragma once

#include <cstddef>
#include <cstdint>

namespace lapwing::cholesky {

// The functions of this header have internal linkage on purpose: the kernels are compiled once per
// instruction set, and the linker must not use one of those copies in the whole program.

/// Number of rows in a strip. A strip stores its rows column after column, so that a column of
/// doubles is one AVX-512 register or two AVX2 registers. Row counts are padded to whole strips
/// with zero rows.
inline constexpr int kStrip = 8;

/// Returns the number of strips that hold `rows` rows.
static inline int strips_of(int rows) {
  return (rows + kStrip - 1) / kStrip;
}

/// Returns the offset of strip s in a lower triangle of strips, in which strip s has 8 (s + 1)
/// columns.
static inline std::size_t triangle_offset(int s) {
  return static_cast<std::size_t>(s) * (static_cast<std::size_t>(s) + 1) * (kStrip * kStrip / 2);
}

/// The part of the factor that one front computes, with `pivots` columns. First come the pivot rows
/// (a lower triangle of strips, the last one `pivots` columns wide), then the update rows (strips
/// of `pivots` columns). Both are padded separately. Diagonal entries hold 1 / l_jj. Entries above
/// the diagonal inside a tile are 0.
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

/// Returns the first number of strip s, counted over pivot and update strips.
template <typename Real>
static inline Real* strip_at(const FrontView<Real>& front, int s) {
  if (s < front.pivot_strips) return front.panel + triangle_offset(s);
  return front.panel + pivot_part_size(front.pivots, front.pivot_strips) +
         static_cast<std::size_t>(s - front.pivot_strips) * kStrip * front.pivots;
}

/// Consecutive rows of a child's update matrix that stay consecutive in the parent: lanes
/// [first, last) of strip `source` go to the lanes `shift` higher of the parent's strip `target`.
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
  const int* position = nullptr;  ///< parent's padded row of each update row
  int pivot_columns = 0;          ///< number of leading rows that are pivots of the parent
  int updates = 0;
  const Piece* pieces_begin = nullptr;
  const Piece* pieces_end = nullptr;  ///< ascending in both source and target
};

/// Vector loads of a child's update matrix may reach this many numbers beyond either end.
inline constexpr std::size_t kUpdateSlack = kStrip;

}  // namespace lapwing::cholesky
