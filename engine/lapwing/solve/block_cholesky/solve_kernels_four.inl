// The triangular solves' inner loops for four right-hand sides, for registers that contain a column
// of a strip. Each number of the factor is then loaded only once. Include this file after
// solve_kernels.inl.

struct FourColumns {
  static constexpr int kWidth = 4;
  static constexpr int kPairs = kStrip / 2;  // registers for the rows of a strip, two rows in each
  static constexpr int kStripRows = kWidth * kStrip;
  static constexpr int kBlockStrips = 32;  // 8 KB of update rows, which are transposed once for all
                                           // pivots

  // The transposed 8 rows of a strip: register r contains right-hand side r of all rows.
  struct Turned {
    Vector side[kWidth];
  };

  LAPWING_INLINE void subtract_at(Real* p, Vector vector) {
    const Vector left = unaligned_at(p) - vector;
    __builtin_memcpy(p, &left, sizeof left);
  }

  // Entry l of the result is entry lane[l] of the concatenation of a and b.
  template <int... lane>
  LAPWING_INLINE Vector shuffled(Vector a, Vector b) {
    return __builtin_shufflevector(a, b, lane...);
  }

  LAPWING_INLINE Turned turn_rows(const Real* rows) {
    Vector p[kPairs];
    LAPWING_UNROLL for (int i = 0; i < kPairs; ++i) p[i] = unaligned_at(rows + 2 * kWidth * i);
    const Vector a = shuffled<0, 4, 8, 12, 1, 5, 9, 13>(p[0], p[1]);
    const Vector b = shuffled<0, 4, 8, 12, 1, 5, 9, 13>(p[2], p[3]);
    const Vector c = shuffled<2, 6, 10, 14, 3, 7, 11, 15>(p[0], p[1]);
    const Vector d = shuffled<2, 6, 10, 14, 3, 7, 11, 15>(p[2], p[3]);
    return {shuffled<0, 1, 2, 3, 8, 9, 10, 11>(a, b), shuffled<4, 5, 6, 7, 12, 13, 14, 15>(a, b),
            shuffled<0, 1, 2, 3, 8, 9, 10, 11>(c, d), shuffled<4, 5, 6, 7, 12, 13, 14, 15>(c, d)};
  }

  // Transposes `turned` back and subtracts it from `rows`.
  LAPWING_INLINE void subtract_turned(const Turned& turned, Real* rows) {
    const auto& s = turned.side;
    const Vector a = shuffled<0, 8, 1, 9, 2, 10, 3, 11>(s[0], s[1]);
    const Vector b = shuffled<4, 12, 5, 13, 6, 14, 7, 15>(s[0], s[1]);
    const Vector c = shuffled<0, 8, 1, 9, 2, 10, 3, 11>(s[2], s[3]);
    const Vector d = shuffled<4, 12, 5, 13, 6, 14, 7, 15>(s[2], s[3]);
    subtract_at(rows, shuffled<0, 1, 8, 9, 2, 3, 10, 11>(a, c));
    subtract_at(rows + 2 * kWidth, shuffled<4, 5, 12, 13, 6, 7, 14, 15>(a, c));
    subtract_at(rows + 4 * kWidth, shuffled<0, 1, 8, 9, 2, 3, 10, 11>(b, d));
    subtract_at(rows + 6 * kWidth, shuffled<4, 5, 12, 13, 6, 7, 14, 15>(b, d));
  }

  // Returns the sum over the 8 rows, for each right-hand side.
  LAPWING_INLINE RowVector sum_of_rows(const Turned& turned) {
    const auto& s = turned.side;
    const Vector a = shuffled<0, 8, 2, 10, 4, 12, 6, 14>(s[0], s[1]) +
                     shuffled<1, 9, 3, 11, 5, 13, 7, 15>(s[0], s[1]);
    const Vector b = shuffled<0, 8, 2, 10, 4, 12, 6, 14>(s[2], s[3]) +
                     shuffled<1, 9, 3, 11, 5, 13, 7, 15>(s[2], s[3]);
    const Vector c = shuffled<0, 1, 8, 9, 4, 5, 12, 13>(a, b) +
                     shuffled<2, 3, 10, 11, 6, 7, 14, 15>(a, b);
    return RowVector{c[0], c[1], c[2], c[3]} + RowVector{c[4], c[5], c[6], c[7]};
  }

  // Subtracts the product of M adjacent strips (their first `count` columns) and y from the rows of
  // these strips.
  template <int M>
  LAPWING_INLINE void subtract(const Real* strip, int count, const Real* y, Real* rows) {
    Turned sum[M] = {};
    const std::size_t next = static_cast<std::size_t>(kStrip) * count;
    for (int k = 0; k < count; ++k) {
      LAPWING_UNROLL for (int m = 0; m < M; ++m) {
        const Vector column = vector_at(strip + next * m + kStrip * k);
        LAPWING_UNROLL for (int r = 0; r < kWidth; ++r) {
          sum[m].side[r] += column * y[kWidth * k + r];
        }
      }
    }
    LAPWING_UNROLL for (int m = 0; m < M; ++m) subtract_turned(sum[m], rows + kStripRows * m);
  }

  // Strips that are consecutive in memory. The first strip has `stride` numbers, and each has
  // `growth` numbers more than the previous one.
  struct Strips {
    const Real* first;
    std::size_t stride;
    std::size_t growth;
    int count;
  };

  // Subtracts the product of N rows of the transposed strips and the transposed rows at `x` from N
  // rows of y.
  template <int N>
  LAPWING_INLINE void subtract_columns(const Strips& strips, const Real* x, Real* y) {
    Turned sum[N] = {};
    const Real* strip = strips.first;
    std::size_t stride = strips.stride;
    for (int s = 0; s < strips.count; ++s) {
      Turned rows;
      LAPWING_UNROLL for (int r = 0; r < kWidth; ++r) {
        rows.side[r] = vector_at(x + kStripRows * s + kStrip * r);
      }
      LAPWING_UNROLL for (int n = 0; n < N; ++n) {
        const Vector column = vector_at(strip + kStrip * n);
        LAPWING_UNROLL for (int r = 0; r < kWidth; ++r) sum[n].side[r] += column * rows.side[r];
      }
      strip += stride;
      stride += strips.growth;
    }
    LAPWING_UNROLL for (int n = 0; n < N; ++n) row_vector_at(y + kWidth * n) -= sum_of_rows(sum[n]);
  }

  LAPWING_INLINE void subtract_columns(Strips strips, int columns, const Real* x, Real* y) {
    if (strips.count == 0) return;
    int k = 0;
    for (; k + 4 <= columns; k += 4, strips.first += 4 * kStrip) {
      subtract_columns<4>(strips, x, y + kWidth * k);
    }
    for (; k < columns; ++k, strips.first += kStrip) {
      subtract_columns<1>(strips, x, y + kWidth * k);
    }
  }

  LAPWING_INLINE void turn_and_store(const Real* rows, Real* turned) {
    const Turned t = turn_rows(rows);
    LAPWING_UNROLL for (int r = 0; r < kWidth; ++r) vector_at(turned + kStrip * r) = t.side[r];
  }

  static void forward_pivots(const View& front, Real* y) {
    for (int s = 0; s < front.pivot_strips; ++s) {
      const Real* strip = strip_at(front, s);
      Real* rows = y + kStripRows * s;
      if (s > 0) subtract<1>(strip, kStrip * s, y, rows);
      const Real* tile = strip + kStrip * kStrip * s;
      Rows<kWidth>::forward_tile(tile, smaller(kStrip, front.pivots - kStrip * s), rows);
    }
  }

  static void forward_updates(const View& front, const Real* y, Real* w, int first,
                              int last) {
    int s = first;
    for (; s + 2 <= last; s += 2) {
      subtract<2>(strip_at(front, front.pivot_strips + s), front.pivots, y, w + kStripRows * s);
    }
    if (s < last) {
      subtract<1>(strip_at(front, front.pivot_strips + s), front.pivots, y, w + kStripRows * s);
    }
  }

  static void backward_updates(const View& front, const Real* w, Real* y, int first,
                               int last) {
    alignas(64) Real x[kBlockStrips * kStripRows];
    const std::size_t stride = static_cast<std::size_t>(kStrip) * front.pivots;
    for (int begin = 0; begin < front.update_strips; begin += kBlockStrips) {
      const int count = smaller(kBlockStrips, front.update_strips - begin);
      for (int s = 0; s < count; ++s) {
        turn_and_store(w + kStripRows * (begin + s), x + kStripRows * s);
      }
      subtract_columns({strip_at(front, front.pivot_strips + begin) + kStrip * first, stride, 0,
                        count},
                       last - first, x, y + kWidth * first);
    }
  }

  static void backward_pivots(const View& front, Real* y, Real* scratch) {
    for (int s = front.pivot_strips - 1; s >= 0; --s) {
      const Real* tile = strip_at(front, s) + kStrip * kStrip * s;
      Real* rows = y + kStripRows * s;
      const int width = smaller(kStrip, front.pivots - kStrip * s);
      const int below = front.pivot_strips - 1 - s;
      if (below > 0) {
        const auto length = static_cast<std::size_t>(kStrip * kStrip);
        subtract_columns({strip_at(front, s + 1) + kStrip * kStrip * s, length * (s + 2), length,
                          below},
                         width, scratch + kStripRows * (s + 1), rows);
      }
      Rows<kWidth>::backward_tile(tile, width, rows);
      if (s > 0) turn_and_store(rows, scratch + kStripRows * s);
    }
  }

  static constexpr SolveKernels<Real> kernels() {
    return {forward_pivots, forward_updates, backward_updates, backward_pivots};
  }
};
