// The factorization's inner loops. kernels_*.cpp include this file inside an unnamed namespace,
// after they define Real (the number type), kLanes (numbers per vector register), kTileStrips and
// kTileColumns (the size of the result's tile in registers). The file calls no function with
// external linkage (see front_layout.h).

using View = FrontView<Real>;

constexpr Real kLargest = std::numeric_limits<Real>::max();

typedef Real Vector __attribute__((vector_size(sizeof(Real) * kLanes), may_alias));
typedef Lane<Real> Bits __attribute__((vector_size(sizeof(Real) * kLanes), may_alias));

constexpr int kParts = kStrip / kLanes;  // registers for one column of a strip

#define LAPWING_INLINE static inline __attribute__((always_inline))
#ifdef __clang__
#define LAPWING_UNROLL _Pragma("clang loop unroll(full)")
#else
#define LAPWING_UNROLL _Pragma("GCC unroll 12")
#endif

// Loads from an unaligned address. Compilers replace the copy by a single load.
LAPWING_INLINE Vector unaligned_at(const Real* p) {
  Vector vector;
  __builtin_memcpy(&vector, p, sizeof vector);
  return vector;
}

LAPWING_INLINE Vector& vector_at(Real* p) { return *reinterpret_cast<Vector*>(p); }
LAPWING_INLINE const Vector& vector_at(const Real* p) {
  return *reinterpret_cast<const Vector*>(p);
}
LAPWING_INLINE int smaller(int a, int b) { return a < b ? a : b; }
LAPWING_INLINE int larger(int a, int b) { return a > b ? a : b; }

// A tile of the result in registers: M strips by N columns.
template <int M, int N>
struct Tile {
  Vector c[M][N][kParts];
};

// Only the first `columns` of the N columns are loaded and stored; the others start at 0.
template <int M, int N, bool kAll>
LAPWING_INLINE void load(Tile<M, N>& tile, Real* const* from, int columns) {
  LAPWING_UNROLL for (int m = 0; m < M; ++m) {
    LAPWING_UNROLL for (int n = 0; n < N; ++n) {
      LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
        tile.c[m][n][part] = kAll || n < columns
                                 ? vector_at(from[m] + kStrip * n + kLanes * part)
                                 : Vector{};
      }
    }
  }
}

template <int M, int N, bool kAll>
LAPWING_INLINE void store(const Tile<M, N>& tile, Real* const* to, int columns) {
  LAPWING_UNROLL for (int m = 0; m < M; ++m) {
    LAPWING_UNROLL for (int n = 0; n < N; ++n) {
      LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
        if (kAll || n < columns) {
          vector_at(to[m] + kStrip * n + kLanes * part) = tile.c[m][n][part];
        }
      }
    }
  }
}

// tile -= A B'. The rows of A are the strips a[m], the rows of B are the lanes b[0..N) of a strip;
// both have `count` columns.
template <int M, int N>
LAPWING_INLINE void subtract_products(Tile<M, N>& tile, int count, const Real* const* a,
                                      const Real* b) {
  for (int k = 0; k < count; ++k) {
    Vector row[M][kParts];
    LAPWING_UNROLL for (int m = 0; m < M; ++m) {
      LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
        row[m][part] = vector_at(a[m] + kStrip * k + kLanes * part);
      }
    }
    LAPWING_UNROLL for (int n = 0; n < N; ++n) {
      const Real factor = b[kStrip * k + n];
      LAPWING_UNROLL for (int m = 0; m < M; ++m) {
        LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
          tile.c[m][n][part] -= row[m][part] * factor;
        }
      }
    }
  }
}

// Computes the columns [column, column + columns) of the factor in M strips. `pivots` is the pivot
// strip that contains the diagonal of these columns, starting at lane `lane`.
template <int M, bool kAll>
LAPWING_INLINE void solve_tile(Real* const* strips, const Real* pivots, int column, int lane,
                               int columns) {
  constexpr int N = kTileColumns;
  Tile<M, N> tile;
  Real* target[M];
  LAPWING_UNROLL for (int m = 0; m < M; ++m) target[m] = strips[m] + kStrip * column;
  load<M, N, kAll>(tile, target, columns);
  subtract_products<M, N>(tile, column, strips, pivots + lane);
  const Real* diagonal = pivots + kStrip * column + lane;
  LAPWING_UNROLL for (int n = 0; n < N; ++n) {
    if (!kAll && n >= columns) break;
    const Real inverse = diagonal[kStrip * n + n];
    LAPWING_UNROLL for (int m = 0; m < M; ++m) {
      LAPWING_UNROLL for (int part = 0; part < kParts; ++part) tile.c[m][n][part] *= inverse;
    }
    LAPWING_UNROLL for (int q = n + 1; q < N; ++q) {
      const Real factor = diagonal[kStrip * n + q];
      LAPWING_UNROLL for (int m = 0; m < M; ++m) {
        LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
          tile.c[m][q][part] -= tile.c[m][n][part] * factor;
        }
      }
    }
  }
  store<M, N, kAll>(tile, target, columns);
}

template <int M>
void solve_strips(const View& front, int first, int first_column, int last_column) {
  Real* strips[M];
  for (int m = 0; m < M; ++m) strips[m] = strip_at(front, first + m);
  for (int s = first_column; s < last_column; ++s) {
    const Real* pivots = strip_at(front, s);
    const int width = smaller(kStrip, front.pivots - kStrip * s);
    for (int lane = 0; lane < width; lane += kTileColumns) {
      if (width - lane >= kTileColumns) {
        solve_tile<M, true>(strips, pivots, kStrip * s + lane, lane, kTileColumns);
      } else {
        solve_tile<M, false>(strips, pivots, kStrip * s + lane, lane, width - lane);
      }
    }
  }
}

void solve_rows(const View& front, int first, int last, int first_column, int last_column) {
  int s = first;
  for (; s + kTileStrips <= last; s += kTileStrips) {
    solve_strips<kTileStrips>(front, s, first_column, last_column);
  }
  if constexpr (kTileStrips > 2) {
    if (last - s == 2) {
      solve_strips<2>(front, s, first_column, last_column);
      return;
    }
  }
  if (s < last) solve_strips<1>(front, s, first_column, last_column);
}

// Factorizes one diagonal tile of `width` columns. The inverse of the diagonal replaces the
// diagonal. Returns the first rejected pivot, or -1.
int factor_tile(Real* tile, int width, const Real* floor) {
  for (int j = 0; j < width; ++j) {
    Real* column = tile + kStrip * j;
    const Real pivot = column[j];
    if (!(pivot > floor[j] && pivot <= kLargest)) return j;
    const Real inverse = Real(1) / static_cast<Real>(__builtin_sqrt(pivot));
    Vector scaled[kParts];
    for (int part = 0; part < kParts; ++part) {
      scaled[part] = vector_at(column + kLanes * part) * inverse;
    }
    for (int q = j + 1; q < width; ++q) {
      const Real factor = column[q] * inverse;
      for (int part = 0; part < kParts; ++part) {
        vector_at(tile + kStrip * q + kLanes * part) -= scaled[part] * factor;
      }
    }
    for (int part = 0; part < kParts; ++part) vector_at(column + kLanes * part) = scaled[part];
    for (int q = 0; q < j; ++q) column[q] = 0.0;
    column[j] = inverse;
  }
  return -1;
}

int factor_pivots(const View& front, int first, int last, const Real* floor) {
  for (int s = first; s < last; ++s) {
    Real* strip = strip_at(front, s);
    const int column = kStrip * s;
    const int width = smaller(kStrip, front.pivots - column);
    for (int lane = 0; lane < width; lane += kTileColumns) {
      Tile<1, kTileColumns> tile;
      Real* target = strip + kStrip * (column + lane);
      const int columns = smaller(kTileColumns, width - lane);
      load<1, kTileColumns, false>(tile, &target, columns);
      subtract_products<1, kTileColumns>(tile, column, &strip, strip + lane);
      store<1, kTileColumns, false>(tile, &target, columns);
    }
    const int refused = factor_tile(strip + kStrip * column, width, floor + column);
    if (refused >= 0) return column + refused;
    solve_rows(front, s + 1, last, s, s + 1);
  }
  return -1;
}

// Writes -A B' to the strips `target`, starting at column `column`. The rows of A are the M strips
// `a`, the rows of B are the strip `b`.
template <int M>
LAPWING_INLINE void product(int pivots, const Real* const* a, const Real* b,
                            Real* const* target, int column) {
  LAPWING_UNROLL for (int lane = 0; lane < kStrip; lane += kTileColumns) {
    Tile<M, kTileColumns> tile{};
    Real* to[M];
    LAPWING_UNROLL for (int m = 0; m < M; ++m) to[m] = target[m] + kStrip * (column + lane);
    subtract_products<M, kTileColumns>(tile, pivots, a, b + lane);
    store<M, kTileColumns, true>(tile, to, kTileColumns);
  }
}

template <int M>
void update_strips(const View& front, Real* matrix, int first) {
  const Real* a[M];
  Real* target[M];
  for (int m = 0; m < M; ++m) {
    a[m] = strip_at(front, front.pivot_strips + first + m);
    target[m] = matrix + triangle_offset(first + m);
  }
  for (int c = 0; c <= first; ++c) {
    product<M>(front.pivots, a, strip_at(front, front.pivot_strips + c), target, kStrip * c);
  }
  if constexpr (M > 1) product<M - 1>(front.pivots, a + 1, a[1], target + 1, kStrip * (first + 1));
  if constexpr (M > 2) product<M - 2>(front.pivots, a + 2, a[2], target + 2, kStrip * (first + 2));
}

void update(const View& front, Real* matrix, int first, int last) {
  int s = first;
  for (; s + kTileStrips <= last; s += kTileStrips) update_strips<kTileStrips>(front, matrix, s);
  if constexpr (kTileStrips > 2) {
    if (last - s == 2) {
      update_strips<2>(front, matrix, s);
      return;
    }
  }
  if (s < last) update_strips<1>(front, matrix, s);
}

// Returns a mask of the lanes [first, last) of part `part` of a strip's column.
LAPWING_INLINE Bits lanes_between(int first, int last, int part) {
  Bits lane;
  LAPWING_UNROLL for (int i = 0; i < kLanes; ++i) lane[i] = kLanes * part + i;
  return (lane >= first) & (lane < last);
}

// target[lane] += source[lane - shift] for the lanes of `mask`.
LAPWING_INLINE void add_lanes(Real* target, const Real* source, int shift, const Bits* mask) {
  LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
    const Vector moved = unaligned_at(source + kLanes * part - shift);
    vector_at(target + kLanes * part) +=
        reinterpret_cast<Vector>(reinterpret_cast<Bits>(moved) & mask[part]);
  }
}

// Adds the part of `piece` in the lower triangle and in the child's columns [first, last). `strip`
// is the address that column 0 of the parent's strip would have.
LAPWING_INLINE void add_piece(const ChildUpdate<Real>& child, const Piece& piece, Real* strip,
                              int first, int last) {
  const int row = kStrip * piece.source;
  const Real* source = child.matrix + triangle_offset(piece.source);
  last = smaller(last, row + piece.last);
  const int whole = smaller(last, row + piece.first + 1);  // columns left of the diagonal
  Bits mask[kParts];
  LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
    mask[part] = lanes_between(piece.first + piece.shift, piece.last + piece.shift, part);
  }
  int j = first;
  for (; j < whole; ++j) {
    add_lanes(strip + static_cast<std::ptrdiff_t>(kStrip) * child.position[j],
              source + kStrip * j, piece.shift, mask);
  }
  for (; j < last; ++j) {
    const int lane = larger(piece.first, j - row);
    LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
      mask[part] = lanes_between(lane + piece.shift, piece.last + piece.shift, part);
    }
    add_lanes(strip + static_cast<std::ptrdiff_t>(kStrip) * child.position[j],
              source + kStrip * j, piece.shift, mask);
  }
}

void add_to_panel(const ChildUpdate<Real>& child, const View& front) {
  for (const Piece* piece = child.pieces_begin; piece != child.pieces_end; ++piece) {
    add_piece(child, *piece, strip_at(front, piece->target), 0, child.pivot_columns);
  }
}

void add_to_update(const ChildUpdate<Real>& child, const View& front, Real* matrix) {
  const std::ptrdiff_t pivot_columns = static_cast<std::ptrdiff_t>(kStrip) * front.pivot_strips;
  for (const Piece* piece = child.pieces_begin; piece != child.pieces_end; ++piece) {
    // Positions include the parent's padded pivot rows, which the update matrix does not contain.
    Real* strip = matrix + triangle_offset(piece->target - front.pivot_strips) -
                    kStrip * pivot_columns;
    add_piece(child, *piece, strip, child.pivot_columns, child.updates);
  }
}
