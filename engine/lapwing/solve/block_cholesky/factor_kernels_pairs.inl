// The factorization's inner loops for registers that hold a column of two strips. Each operation
// computes twice as many numbers, but the two halves of a register must be loaded separately,
// because the strips are not adjacent in memory. Include this file after factor_kernels.inl, whose
// solve_strips and update_strips compute a remaining single strip. Both files compute each number
// by the same operations.

struct StripPairs {
  static constexpr int kPairs = 3;  // per tile: 24 registers for the result, 3 for rows, 1 factor
  static constexpr int kColumns = kStrip;

  typedef Real PairVector __attribute__((vector_size(2 * sizeof(Real) * kStrip), may_alias));

  LAPWING_INLINE PairVector pair_at(const Real* low, const Real* high) {
    return __builtin_shufflevector(vector_at(low), vector_at(high), 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,
                                   10, 11, 12, 13, 14, 15);
  }
  LAPWING_INLINE void store_low(PairVector pair, Real* to) {
    vector_at(to) = __builtin_shufflevector(pair, pair, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  LAPWING_INLINE void store_high(PairVector pair, Real* to) {
    vector_at(to) = __builtin_shufflevector(pair, pair, 8, 9, 10, 11, 12, 13, 14, 15);
  }

  // A tile of the result in registers: P pairs of strips by 8 columns.
  template <int P>
  struct PairTile {
    PairVector c[P][kColumns];
  };

  // tile -= A B'. The rows of A are the strips a[0..2 P), the rows of B are the strip b; both have
  // `count` columns.
  template <int P>
  LAPWING_INLINE void subtract_pairs(PairTile<P>& tile, int count, const Real* const* a,
                                     const Real* b) {
    for (int k = 0; k < count; ++k) {
      PairVector row[P];
      LAPWING_UNROLL for (int p = 0; p < P; ++p) {
        row[p] = pair_at(a[2 * p] + kStrip * k, a[2 * p + 1] + kStrip * k);
      }
      LAPWING_UNROLL for (int n = 0; n < kColumns; ++n) {
        const Real factor = b[kStrip * k + n];
        LAPWING_UNROLL for (int p = 0; p < P; ++p) tile.c[p][n] -= row[p] * factor;
      }
    }
  }

  // Computes the entries of the factor in strips[0..2 P) and in the columns of pivot strip `s`.
  template <int P>
  LAPWING_INLINE void solve_pairs_in(const View& front, Real* const* strips, int s) {
    const Real* pivots = strip_at(front, s);
    const int width = smaller(kStrip, front.pivots - kStrip * s);
    const int column = kStrip * kStrip * s;
    PairTile<P> tile;
    LAPWING_UNROLL for (int p = 0; p < P; ++p) {
      LAPWING_UNROLL for (int n = 0; n < kColumns; ++n) {
        tile.c[p][n] = n < width ? pair_at(strips[2 * p] + column + kStrip * n,
                                           strips[2 * p + 1] + column + kStrip * n)
                                 : PairVector{};
      }
    }
    subtract_pairs<P>(tile, kStrip * s, strips, pivots);
    const Real* diagonal = pivots + column;
    LAPWING_UNROLL for (int n = 0; n < kColumns; ++n) {
      if (n >= width) break;
      const Real inverse = diagonal[kStrip * n + n];
      LAPWING_UNROLL for (int p = 0; p < P; ++p) tile.c[p][n] *= inverse;
      LAPWING_UNROLL for (int q = n + 1; q < kColumns; ++q) {
        const Real factor = diagonal[kStrip * n + q];
        LAPWING_UNROLL for (int p = 0; p < P; ++p) tile.c[p][q] -= tile.c[p][n] * factor;
      }
      LAPWING_UNROLL for (int p = 0; p < P; ++p) {
        store_low(tile.c[p][n], strips[2 * p] + column + kStrip * n);
        store_high(tile.c[p][n], strips[2 * p + 1] + column + kStrip * n);
      }
    }
  }

  template <int P>
  static void solve_pairs(const View& front, int first, int first_column, int last_column) {
    Real* strips[2 * P];
    for (int m = 0; m < 2 * P; ++m) strips[m] = strip_at(front, first + m);
    for (int s = first_column; s < last_column; ++s) solve_pairs_in<P>(front, strips, s);
  }

  static void solve_rows(const View& front, int first, int last, int first_column,
                         int last_column) {
    int s = first;
    for (; s + 2 * kPairs <= last; s += 2 * kPairs) {
      solve_pairs<kPairs>(front, s, first_column, last_column);
    }
    for (; s + 2 <= last; s += 2) solve_pairs<1>(front, s, first_column, last_column);
    if (s < last) solve_strips<1>(front, s, first_column, last_column);
  }

  // Writes -A B' to the strips `target`, starting at column `column`. The rows of A are P pairs of
  // strips, the rows of B are the strip `b`. If `is_short` is true, the first target strip ends
  // before `column` and is skipped.
  template <int P, bool is_short>
  LAPWING_INLINE void product_of_pairs(int pivots, const Real* const* a, const Real* b,
                                       Real* const* target, int column) {
    PairTile<P> tile{};
    subtract_pairs<P>(tile, pivots, a, b);
    LAPWING_UNROLL for (int p = 0; p < P; ++p) {
      LAPWING_UNROLL for (int n = 0; n < kColumns; ++n) {
        if (!is_short || p > 0) store_low(tile.c[p][n], target[2 * p] + kStrip * (column + n));
        store_high(tile.c[p][n], target[2 * p + 1] + kStrip * (column + n));
      }
    }
  }

  // Computes the columns at the diagonal of P pairs of strips. Each strip ends 8 columns after the
  // previous one.
  template <int P>
  LAPWING_INLINE void last_products(int pivots, const Real* const* a, Real* const* target,
                                    int first) {
    product_of_pairs<P, false>(pivots, a, a[0], target, kStrip * first);
    product_of_pairs<P, true>(pivots, a, a[1], target, kStrip * (first + 1));
    if constexpr (P > 1) last_products<P - 1>(pivots, a + 2, target + 2, first + 2);
  }

  template <int P>
  static void update_pairs(const View& front, Real* matrix, int first) {
    const Real* a[2 * P];
    Real* target[2 * P];
    for (int m = 0; m < 2 * P; ++m) {
      a[m] = strip_at(front, front.pivot_strips + first + m);
      target[m] = matrix + triangle_offset(first + m);
    }
    for (int c = 0; c < first; ++c) {
      product_of_pairs<P, false>(front.pivots, a, strip_at(front, front.pivot_strips + c), target,
                                 kStrip * c);
    }
    last_products<P>(front.pivots, a, target, first);
  }

  static void update(const View& front, Real* matrix, int first, int last) {
    int s = first;
    for (; s + 2 * kPairs <= last; s += 2 * kPairs) update_pairs<kPairs>(front, matrix, s);
    for (; s + 2 <= last; s += 2) update_pairs<1>(front, matrix, s);
    if (s < last) update_strips<1>(front, matrix, s);
  }

  static constexpr KernelTable<Real> table(KernelTable<Real> of_strips) {
    of_strips.solve_rows = solve_rows;
    of_strips.update = update;
    return of_strips;
  }
};
