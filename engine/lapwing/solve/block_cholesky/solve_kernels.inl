// The triangular solves' inner loops. Include this file after factor_kernels.inl.

// ---- One right-hand side: a register contains consecutive rows of a strip.

// Number of independent partial sums; with a single sum, each addition would wait for the one
// before.
constexpr int kChains = kParts == 1 ? 4 : 2;

struct StripSum {
  Vector part[kParts];
};

// Returns the 8 numbers at `from` minus the product of the strip's first `count` columns and y.
LAPWING_INLINE StripSum subtract_strip(const Real* strip, int count, const Real* y,
                                       const Real* from) {
  Vector sums[kChains][kParts] = {};
  LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
    sums[0][part] = vector_at(from + kLanes * part);
  }
  int k = 0;
  for (; k + kChains <= count; k += kChains) {
    LAPWING_UNROLL for (int chain = 0; chain < kChains; ++chain) {
      LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
        sums[chain][part] -=
            vector_at(strip + kStrip * (k + chain) + kLanes * part) * y[k + chain];
      }
    }
  }
  for (; k < count; ++k) {
    LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
      sums[0][part] -= vector_at(strip + kStrip * k + kLanes * part) * y[k];
    }
  }
  StripSum total;
  LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
    Vector sum = sums[0][part];
    LAPWING_UNROLL for (int chain = 1; chain < kChains; ++chain) sum += sums[chain][part];
    total.part[part] = sum;
  }
  return total;
}

void forward_pivots_1(const View& front, Real* y) {
  for (int s = 0; s < front.pivot_strips; ++s) {
    const Real* strip = strip_at(front, s);
    StripSum sum = subtract_strip(strip, kStrip * s, y, y + kStrip * s);
    const Real* tile = strip + kStrip * kStrip * s;
    const int width = smaller(kStrip, front.pivots - kStrip * s);
    LAPWING_UNROLL for (int j = 0; j < kStrip; ++j) {
      if (j >= width) break;
      const Real x = sum.part[j / kLanes][j % kLanes] * tile[kStrip * j + j];
      y[kStrip * s + j] = x;
      LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
        sum.part[part] -= vector_at(tile + kStrip * j + kLanes * part) * x;
      }
    }
  }
}

void forward_updates_1(const View& front, const Real* y, Real* w, int first, int last) {
  for (int s = first; s < last; ++s) {
    const Real* strip = strip_at(front, front.pivot_strips + s);
    const StripSum sum = subtract_strip(strip, front.pivots, y, w + kStrip * s);
    LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
      vector_at(w + kStrip * s + kLanes * part) = sum.part[part];
    }
  }
}

// Returns the sum of 8 numbers, in the same order for every register width.
LAPWING_INLINE Real sum_of_strip(const Real* v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

void backward_updates_1(const View& front, const Real* w, Real* y, int first, int last) {
  constexpr int kColumns = 64;  // the sums fit into the L1 cache, and 64 columns of doubles fill
                                // one page
  alignas(64) Real sums[kColumns * kStrip];
  for (int begin = first; begin < last; begin += kColumns) {
    const int columns = smaller(kColumns, last - begin);
    for (int k = 0; k < kStrip * columns; ++k) sums[k] = 0.0;
    for (int s = 0; s < front.update_strips; ++s) {
      const Real* strip = strip_at(front, front.pivot_strips + s) + kStrip * begin;
      Vector x[kParts];
      LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
        x[part] = vector_at(w + kStrip * s + kLanes * part);
      }
      for (int k = 0; k < columns; ++k) {
        LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
          vector_at(sums + kStrip * k + kLanes * part) +=
              vector_at(strip + kStrip * k + kLanes * part) * x[part];
        }
      }
    }
    for (int k = 0; k < columns; ++k) y[begin + k] -= sum_of_strip(sums + kStrip * k);
  }
}

void backward_pivots_1(const View& front, Real* y, Real* scratch) {
  for (int k = 0; k < kStrip * front.pivots; ++k) scratch[k] = 0.0;
  for (int s = front.pivot_strips - 1; s >= 0; --s) {
    const Real* strip = strip_at(front, s);
    const Real* tile = strip + kStrip * kStrip * s;
    const int width = smaller(kStrip, front.pivots - kStrip * s);
    alignas(64) Real x[kStrip] = {};
    for (int j = width - 1; j >= 0; --j) {
      Real rest = y[kStrip * s + j] - sum_of_strip(scratch + kStrip * (kStrip * s + j));
      for (int i = j + 1; i < width; ++i) rest -= tile[kStrip * j + i] * x[i];
      x[j] = rest * tile[kStrip * j + j];
      y[kStrip * s + j] = x[j];
    }
    Vector v[kParts];
    LAPWING_UNROLL for (int part = 0; part < kParts; ++part) v[part] = vector_at(x + kLanes * part);
    for (int k = 0; k < kStrip * s; ++k) {
      LAPWING_UNROLL for (int part = 0; part < kParts; ++part) {
        vector_at(scratch + kStrip * k + kLanes * part) +=
            vector_at(strip + kStrip * k + kLanes * part) * v[part];
      }
    }
  }
}

// ---- Several right-hand sides: a register contains the right-hand sides of one row.

constexpr int kRowLanes = kLanes < 4 ? kLanes : 4;
typedef Real RowVector __attribute__((vector_size(sizeof(Real) * kRowLanes), may_alias));

LAPWING_INLINE RowVector& row_vector_at(Real* p) { return *reinterpret_cast<RowVector*>(p); }
LAPWING_INLINE const RowVector& row_vector_at(const Real* p) {
  return *reinterpret_cast<const RowVector*>(p);
}

// Returns how many rows of sums fit into the registers together with one row of factors.
constexpr int rows_at_once(int row_registers) {
  int rows = kStrip;
  while (rows > 2 && (rows + 1) * row_registers >= kRegisters) rows /= 2;
  return rows;
}

// The kernels for `kWidth` right-hand sides.
template <int kWidth>
struct Rows {
  static constexpr int kRowRegisters = kWidth / kRowLanes;  // registers per row
  static constexpr int kSolveRows = rows_at_once(kRowRegisters);

  // Subtracts the product of the strip's first `count` columns and y from the rows `target`.
  LAPWING_INLINE void subtract(const Real* strip, int count, const Real* y, Real* target) {
    for (int lane = 0; lane < kStrip; lane += kSolveRows) {
      RowVector sum[kSolveRows][kRowRegisters];
      LAPWING_UNROLL for (int i = 0; i < kSolveRows; ++i) {
        LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) {
          sum[i][r] = row_vector_at(target + kWidth * (lane + i) + kRowLanes * r);
        }
      }
      for (int k = 0; k < count; ++k) {
        RowVector row[kRowRegisters];
        LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) {
          row[r] = row_vector_at(y + kWidth * k + kRowLanes * r);
        }
        LAPWING_UNROLL for (int i = 0; i < kSolveRows; ++i) {
          const Real factor = strip[kStrip * k + lane + i];
          LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) sum[i][r] -= row[r] * factor;
        }
      }
      LAPWING_UNROLL for (int i = 0; i < kSolveRows; ++i) {
        LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) {
          row_vector_at(target + kWidth * (lane + i) + kRowLanes * r) = sum[i][r];
        }
      }
    }
  }

  // Subtracts the product of the transposed strip and 8 rows of x from the rows [first, last) of y.
  LAPWING_INLINE void subtract_transposed(const Real* strip, const Real* x, Real* y,
                                          int first, int last) {
    for (int lane = 0; lane < kStrip; lane += kSolveRows) {
      RowVector row[kSolveRows][kRowRegisters];
      LAPWING_UNROLL for (int i = 0; i < kSolveRows; ++i) {
        LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) {
          row[i][r] = row_vector_at(x + kWidth * (lane + i) + kRowLanes * r);
        }
      }
      for (int k = first; k < last; ++k) {
        RowVector sum[kRowRegisters];
        LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) {
          sum[r] = row_vector_at(y + kWidth * k + kRowLanes * r);
        }
        LAPWING_UNROLL for (int i = 0; i < kSolveRows; ++i) {
          const Real factor = strip[kStrip * k + lane + i];
          LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) sum[r] -= row[i][r] * factor;
        }
        LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) {
          row_vector_at(y + kWidth * k + kRowLanes * r) = sum[r];
        }
      }
    }
  }

  // Solves a diagonal tile of `width` pivots for one register of right-hand sides.
  LAPWING_INLINE void forward_tile(const Real* tile, int width, Real* rows) {
    RowVector row[kStrip];
    LAPWING_UNROLL for (int i = 0; i < kStrip; ++i) row[i] = row_vector_at(rows + kWidth * i);
    LAPWING_UNROLL for (int j = 0; j < kStrip; ++j) {
      if (j >= width) break;
      row[j] *= tile[kStrip * j + j];
      LAPWING_UNROLL for (int i = j + 1; i < kStrip; ++i) row[i] -= row[j] * tile[kStrip * j + i];
    }
    LAPWING_UNROLL for (int i = 0; i < kStrip; ++i) row_vector_at(rows + kWidth * i) = row[i];
  }

  LAPWING_INLINE void backward_tile(const Real* tile, int width, Real* rows) {
    RowVector row[kStrip];
    LAPWING_UNROLL for (int i = 0; i < kStrip; ++i) row[i] = row_vector_at(rows + kWidth * i);
    LAPWING_UNROLL for (int j = kStrip - 1; j >= 0; --j) {
      if (j >= width) continue;
      row[j] *= tile[kStrip * j + j];
      LAPWING_UNROLL for (int i = 0; i < j; ++i) row[i] -= row[j] * tile[kStrip * i + j];
    }
    LAPWING_UNROLL for (int i = 0; i < kStrip; ++i) row_vector_at(rows + kWidth * i) = row[i];
  }

  static void forward_pivots(const View& front, Real* y) {
    for (int s = 0; s < front.pivot_strips; ++s) {
      const Real* strip = strip_at(front, s);
      Real* rows = y + kWidth * kStrip * s;
      subtract(strip, kStrip * s, y, rows);
      const Real* tile = strip + kStrip * kStrip * s;
      const int width = smaller(kStrip, front.pivots - kStrip * s);
      LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) {
        forward_tile(tile, width, rows + kRowLanes * r);
      }
    }
  }

  static void forward_updates(const View& front, const Real* y, Real* w, int first,
                              int last) {
    for (int s = first; s < last; ++s) {
      subtract(strip_at(front, front.pivot_strips + s), front.pivots, y, w + kWidth * kStrip * s);
    }
  }

  static void backward_updates(const View& front, const Real* w, Real* y, int first,
                               int last) {
    for (int s = 0; s < front.update_strips; ++s) {
      subtract_transposed(strip_at(front, front.pivot_strips + s), w + kWidth * kStrip * s, y,
                          first, last);
    }
  }

  static void backward_pivots(const View& front, Real* y, Real* /*scratch*/) {
    for (int s = front.pivot_strips - 1; s >= 0; --s) {
      const Real* strip = strip_at(front, s);
      const Real* tile = strip + kStrip * kStrip * s;
      Real* rows = y + kWidth * kStrip * s;
      const int width = smaller(kStrip, front.pivots - kStrip * s);
      LAPWING_UNROLL for (int r = 0; r < kRowRegisters; ++r) {
        backward_tile(tile, width, rows + kRowLanes * r);
      }
      subtract_transposed(strip, rows, y, 0, kStrip * s);
    }
  }

  static constexpr SolveKernels<Real> kernels() {
    return {forward_pivots, forward_updates, backward_updates, backward_pivots};
  }
};

// `four` contains the kernels for four right-hand sides.
constexpr KernelTable<Real> kernel_table(const SolveKernels<Real>& four) {
  return {factor_pivots,
          solve_rows,
          update,
          add_to_panel,
          add_to_update,
          {{forward_pivots_1, forward_updates_1, backward_updates_1, backward_pivots_1},
           four,
           Rows<8>::kernels(),
           Rows<12>::kernels()}};
}
