// The inner loops of fit_rotations and energy_gradient (CpuRingRotations). A batch of rotations is
// fitted kLanes rows at a time, as many as fit in a register, because compilers split wider vectors
// into single numbers. ring_loops_*.cpp include this file inside an unnamed namespace, after they
// define kLanes. It calls no function with external linkage, for which the linker could use the
// copy of another instruction set.

static_assert(kFitLanes % kLanes == 0);

typedef double Lanes __attribute__((vector_size(sizeof(double) * kLanes), may_alias));
typedef long long LaneBits __attribute__((vector_size(sizeof(double) * kLanes)));
typedef float RoughLanes __attribute__((vector_size(sizeof(float) * kLanes)));

#define LAPWING_INLINE static inline __attribute__((always_inline))

// As in laplacian/rotation.cpp: if the product of the distances to the other eigenvalues is
// smaller, the eigenvector loses half of its digits.
constexpr double kSmallestGap = 1e-6;
// Newton steps without a test of convergence. A well-conditioned root needs three or four steps
// from the upper bound.
constexpr int kUncheckedNewtonSteps = 2;
constexpr int kMostNewtonSteps = 12;
// Convergence is quadratic, so the error after such a small step is negligible.
constexpr double kConverged = 1e-9;

LAPWING_INLINE Lanes absolute(Lanes x) { return x < 0.0 ? -x : x; }
LAPWING_INLINE Lanes square_root(Lanes x) {
  Lanes root;
  for (int l = 0; l < kLanes; ++l) root[l] = __builtin_sqrt(x[l]);
  return root;
}

LAPWING_INLINE bool any(LaneBits bits) {
  long long all = 0;
  for (int l = 0; l < kLanes; ++l) all |= bits[l];
  return all != 0;
}
LAPWING_INLINE Lanes& lanes_at(double* p) { return *reinterpret_cast<Lanes*>(p); }
LAPWING_INLINE const Lanes& lanes_at(const double* p) { return *reinterpret_cast<const Lanes*>(p); }

LAPWING_INLINE RoughLanes rough(Lanes x) { return __builtin_convertvector(x, RoughLanes); }
LAPWING_INLINE Lanes exact(RoughLanes x) { return __builtin_convertvector(x, Lanes); }
LAPWING_INLINE Lanes rough_root(Lanes x) {
  const RoughLanes square = rough(x);
  RoughLanes root;
  for (int l = 0; l < kLanes; ++l) root[l] = __builtin_sqrtf(square[l]);
  return exact(root);
}

struct Points {
  Lanes axis[3];
};

// Returns the displacement of each lane's vertex.
LAPWING_INLINE Points gather(const PaddedVector* displacement, const std::uint32_t* vertices) {
  Points points;
  for (int a = 0; a < 3; ++a) {
    for (int l = 0; l < kLanes; ++l) points.axis[a][l] = displacement[vertices[l]].xyz0[a];
  }
  return points;
}

LAPWING_INLINE void number_rows(const FitRings& rings, int first, std::uint32_t* rows) {
  for (int lane = 0; lane < kLanes; ++lane) {
    rows[lane] = rings.first_row + static_cast<std::uint32_t>(first + lane);
  }
}

// Computes C and `moved`.
LAPWING_INLINE void sum_rings(const FitRings& rings, int first, FitBatch& batch) {
  std::uint32_t rows[kLanes];
  number_rows(rings, first, rows);
  const Points here = gather(rings.displacement, rows);
  Lanes C[9] = {};
  Lanes moved[3];
  for (int a = 0; a < 3; ++a) {
    moved[a] = lanes_at(rings.rest.delta[a] + first);
  }
  for (std::size_t k = 0; k < rings.entry_count; ++k) {
    const FitEntries& entry = rings.entries[k];
    const Points there = gather(rings.displacement, entry.neighbour + first);
    for (int a = 0; a < 3; ++a) {
      const Lanes shift = there.axis[a] - here.axis[a];
      const Lanes pull =
          lanes_at(entry.stiffness + first) * (lanes_at(entry.edge[a] + first) + shift);
      moved[a] -= shift * lanes_at(entry.weight + first);
      for (int c = 0; c < 3; ++c) C[3 * c + a] += pull * lanes_at(entry.edge[c] + first);
    }
  }
  for (int a = 0; a < 3; ++a) {
    const Lanes pull = lanes_at(rings.rest.weight + first) * moved[a];
    lanes_at(batch.moved[a] + first) = moved[a];
    for (int c = 0; c < 3; ++c) {
      lanes_at(batch.C[3 * c + a] + first) =
          C[3 * c + a] + pull * lanes_at(rings.rest.delta[c] + first);
    }
  }
}

struct Root {
  Lanes value;
  LaneBits found;  // true if the iteration has converged and the slope is large enough
};

// Returns the largest root of Horn's matrix for |H| = 1, like largest_root in
// laplacian/rotation.cpp.
LAPWING_INLINE Root largest_root(const Lanes* H) {
  const Lanes c0 = H[4] * H[8] - H[5] * H[7];
  const Lanes c1 = H[5] * H[6] - H[3] * H[8];
  const Lanes c2 = H[3] * H[7] - H[4] * H[6];
  const Lanes c3 = H[7] * H[2] - H[8] * H[1];
  const Lanes c4 = H[8] * H[0] - H[6] * H[2];
  const Lanes c5 = H[6] * H[1] - H[7] * H[0];
  const Lanes c6 = H[1] * H[5] - H[2] * H[4];
  const Lanes c7 = H[2] * H[3] - H[0] * H[5];
  const Lanes c8 = H[0] * H[4] - H[1] * H[3];
  const Lanes determinant = H[0] * c0 + H[1] * c1 + H[2] * c2;
  const Lanes squares = c0 * c0 + c1 * c1 + c2 * c2 + c3 * c3 + c4 * c4 + c5 * c5 + c6 * c6 +
                        c7 * c7 + c8 * c8;
  const Lanes b = -8.0 * determinant;
  const Lanes c = 1.0 - 4.0 * squares;
  // The root l is the sum of the singular values, where the last one has the sign of the
  // determinant. Therefore
  //     l^2 = 1 + 2 sqrt(squares + 2 determinant l) and l^2 <= 3.
  // This gives an upper bound, which is rounded up.
  const Lanes positive = determinant > 0.0 ? determinant : Lanes{};
  Lanes l = rough_root(1.0 + 2.0 * rough_root(squares + 3.4641016151377544 * positive)) * 1.000001;
  Lanes down = {};
  Lanes slope = {};
  LaneBits moving = ~LaneBits{};
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    slope = (4.0 * l * l - 4.0) * l + b;
    const Lanes value = ((l * l - 2.0) * l + b) * l + c;
    down = (moving & (slope > kSmallestGap)) ? value / slope : Lanes{};
    l -= down;
    if (step < kUncheckedNewtonSteps) continue;
    // The result of a row must not depend on the other rows in the register.
    moving &= down > kConverged;
    if (!any(moving)) break;
  }
  slope = (4.0 * l * l - 4.0) * l + b;
  return {l, (slope > kSmallestGap) & (absolute(down) <= kConverged)};
}

// Computes R from C, both column-major. Returns a bit for every lane whose R is unreliable.
LAPWING_INLINE unsigned rotate(const FitBatch& batch, int first, Lanes* R) {
  Lanes H[9];
  Lanes square = {};
  for (int k = 0; k < 9; ++k) {
    H[k] = lanes_at(batch.C[k] + first);
    square += H[k] * H[k];
  }
  const LaneBits usable = (square > 0.0) & (square < 1e300);
  const Lanes inverse = 1.0 / square_root(usable ? square : Lanes{} + 1.0);
  for (int k = 0; k < 9; ++k) H[k] = usable ? H[k] * inverse : Lanes{};
  const Root root = largest_root(H);

  // N - l I, where N is the matrix of quaternion_form in laplacian/rotation.cpp.
  const Lanes a00 = H[0] + H[4] + H[8] - root.value;
  const Lanes a11 = H[0] - H[4] - H[8] - root.value;
  const Lanes a22 = H[4] - H[0] - H[8] - root.value;
  const Lanes a33 = H[8] - H[0] - H[4] - root.value;
  const Lanes a01 = H[5] - H[7];
  const Lanes a02 = H[6] - H[2];
  const Lanes a03 = H[1] - H[3];
  const Lanes a12 = H[1] + H[3];
  const Lanes a13 = H[2] + H[6];
  const Lanes a23 = H[5] + H[7];

  // Its adjugate is a multiple of q q', so the column with the largest diagonal entry is a multiple
  // of q.
  const Lanes s0 = a00 * a11 - a01 * a01;
  const Lanes s1 = a00 * a12 - a01 * a02;
  const Lanes s2 = a00 * a13 - a01 * a03;
  const Lanes s3 = a01 * a12 - a11 * a02;
  const Lanes s4 = a01 * a13 - a11 * a03;
  const Lanes s5 = a02 * a13 - a12 * a03;
  const Lanes t5 = a22 * a33 - a23 * a23;
  const Lanes t4 = a12 * a33 - a13 * a23;
  const Lanes t3 = a12 * a23 - a13 * a22;
  const Lanes t2 = a02 * a33 - a03 * a23;
  const Lanes t1 = a02 * a23 - a03 * a22;
  const Lanes b00 = a11 * t5 - a12 * t4 + a13 * t3;
  const Lanes b01 = a02 * t4 - a01 * t5 - a03 * t3;
  const Lanes b02 = a13 * s5 - a23 * s4 + a33 * s3;
  const Lanes b03 = a22 * s4 - a12 * s5 - a23 * s3;
  const Lanes b11 = a00 * t5 - a02 * t2 + a03 * t1;
  const Lanes b12 = a23 * s2 - a03 * s5 - a33 * s1;
  const Lanes b13 = a02 * s5 - a22 * s2 + a23 * s1;
  const Lanes b22 = a03 * s4 - a13 * s2 + a33 * s0;
  const Lanes b23 = a12 * s2 - a02 * s4 - a23 * s0;
  const Lanes b33 = a02 * s3 - a12 * s1 + a22 * s0;
  Lanes w = b00;
  Lanes x = b01;
  Lanes y = b02;
  Lanes z = b03;
  Lanes most = absolute(b00);
  const auto take = [&](Lanes diagonal, Lanes q0, Lanes q1, Lanes q2, Lanes q3) {
    const LaneBits larger = absolute(diagonal) > most;
    most = larger ? absolute(diagonal) : most;
    w = larger ? q0 : w;
    x = larger ? q1 : x;
    y = larger ? q2 : y;
    z = larger ? q3 : z;
  };
  take(b11, b01, b11, b12, b13);
  take(b22, b02, b12, b22, b23);
  take(b33, b03, b13, b23, b33);
  const LaneBits sure = usable & root.found & (most > 0.0);
  const Lanes size = w * w + x * x + y * y + z * z;
  const Lanes scale = 2.0 / (sure ? size : Lanes{} + 1.0);
  R[0] = 1.0 - scale * (y * y + z * z);
  R[1] = scale * (x * y + w * z);
  R[2] = scale * (x * z - w * y);
  R[3] = scale * (x * y - w * z);
  R[4] = 1.0 - scale * (x * x + z * z);
  R[5] = scale * (y * z + w * x);
  R[6] = scale * (x * z + w * y);
  R[7] = scale * (y * z - w * x);
  R[8] = 1.0 - scale * (x * x + y * y);
  unsigned unsure = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    if (!sure[lane]) unsure |= 1U << static_cast<unsigned>(first + lane);
  }
  return unsure;
}

// Computes residual and energy from T. Differences of edges are computed from displacements and T -
// I, so that small differences are accurate.
LAPWING_INLINE void finish(const FitRings& rings, int first, FitBatch& batch) {
  std::uint32_t rows[kLanes];
  number_rows(rings, first, rows);
  Lanes change[9];  // T - I
  for (int k = 0; k < 9; ++k) change[k] = lanes_at(batch.T[k] + first) - (k % 4 == 0 ? 1.0 : 0.0);
  Lanes energy = {};
  for (int a = 0; a < 3; ++a) {
    const Lanes wish = lanes_at(batch.T[a] + first) * lanes_at(rings.rest.delta[0] + first) +
                       lanes_at(batch.T[3 + a] + first) * lanes_at(rings.rest.delta[1] + first) +
                       lanes_at(batch.T[6 + a] + first) * lanes_at(rings.rest.delta[2] + first);
    const Lanes off = lanes_at(batch.moved[a] + first) - wish;
    const Lanes weighted = lanes_at(rings.rest.weight + first) * off;
    lanes_at(batch.residual[a] + first) = weighted;
    energy += weighted * off;
  }
  const Points here = gather(rings.displacement, rows);
  for (std::size_t k = 0; k < rings.entry_count; ++k) {
    const FitEntries& entry = rings.entries[k];
    const Points there = gather(rings.displacement, entry.neighbour + first);
    Lanes square = {};
    for (int a = 0; a < 3; ++a) {
      const Lanes off = there.axis[a] - here.axis[a] -
                        (change[a] * lanes_at(entry.edge[0] + first) +
                         change[3 + a] * lanes_at(entry.edge[1] + first) +
                         change[6 + a] * lanes_at(entry.edge[2] + first));
      square += off * off;
    }
    energy += lanes_at(entry.stiffness + first) * square;
  }
  lanes_at(batch.energy + first) = energy;
}

// Replaces `m` by `m` S, where S is the rest stretch; both are column-major.
LAPWING_INLINE void stretch_from_right(const FitStretch& stretch, int first, Lanes* m) {
  constexpr int kEntry[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  for (int row = 0; row < 3; ++row) {
    const Lanes old[3] = {m[row], m[3 + row], m[6 + row]};
    for (int column = 0; column < 3; ++column) {
      m[3 * column + row] = old[0] * lanes_at(stretch.S[kEntry[0][column]] + first) +
                            old[1] * lanes_at(stretch.S[kEntry[1][column]] + first) +
                            old[2] * lanes_at(stretch.S[kEntry[2][column]] + first);
    }
  }
}

LAPWING_INLINE void stretch_moments(const FitStretch& stretch, int first, FitBatch& batch) {
  Lanes C[9];
  for (int k = 0; k < 9; ++k) C[k] = lanes_at(batch.C[k] + first);
  stretch_from_right(stretch, first, C);
  for (int k = 0; k < 9; ++k) lanes_at(batch.C[k] + first) = C[k];
}

unsigned fit_batch(const FitRings& rings, FitBatch& batch) {
  unsigned unsure = 0;
  for (int first = 0; first < kFitLanes; first += kLanes) {
    sum_rings(rings, first, batch);
    if (rings.stretch != nullptr) stretch_moments(*rings.stretch, first, batch);
    Lanes T[9];
    unsure |= rotate(batch, first, T);
    if (rings.stretch != nullptr) stretch_from_right(*rings.stretch, first, T);
    for (int k = 0; k < 9; ++k) lanes_at(batch.T[k] + first) = T[k];
    finish(rings, first, batch);
  }
  return unsure;
}

void finish_batch(const FitRings& rings, FitBatch& batch) {
  for (int first = 0; first < kFitLanes; first += kLanes) finish(rings, first, batch);
}

// A vector in energy_gradient. Arithmetic is equally fast if a register contains only half of it.
typedef double Padded __attribute__((vector_size(sizeof(PaddedVector)), may_alias));

LAPWING_INLINE const Padded& padded(const PaddedVector& vector) {
  return *reinterpret_cast<const Padded*>(vector.xyz0);
}

LAPWING_INLINE Padded turned(const PaddedTurn& turn, double x, double y, double z) {
  return padded(turn.column[0]) * x + padded(turn.column[1]) * y + padded(turn.column[2]) * z;
}

// Returns the edge terms of a row's gradient. Edges point from the row to its neighbours, opposite
// to those in RingRotations; the two signs cancel.
LAPWING_INLINE Padded edge_forces(const GradientRings& rings, std::size_t row) {
  const Padded here = padded(rings.displacement[row]);
  double own[3] = {};  // sum of k (v_j - v_i), to which T_i - I is applied once
  Padded sum = {};
  for (std::size_t e = rings.starts[row]; e < rings.starts[row + 1]; ++e) {
    const std::size_t j = rings.neighbours[e];
    const double* edge = rings.edges + 3 * e;
    const double k = rings.stiffness[e];
    const double shares = j < rings.row_count ? 2.0 : 1.0;
    for (int a = 0; a < 3; ++a) own[a] += k * edge[a];
    sum -= k * (shares * (padded(rings.displacement[j]) - here) -
                turned(rings.turns[j], edge[0], edge[1], edge[2]));
  }
  return sum + turned(rings.turns[row], own[0], own[1], own[2]);
}

void gradient(const GradientRings& rings, std::size_t first, std::size_t last, double* g) {
  for (std::size_t k = first; k < last; ++k) {
    const std::size_t row = rings.unknown_rows[k];
    Padded sum = padded(rings.residuals[row]);
    for (std::size_t e = rings.starts[row]; e < rings.starts[row + 1]; ++e) {
      sum -= rings.reverse_weights[e] * padded(rings.residuals[rings.neighbours[e]]);
    }
    if (rings.stiffness != nullptr) sum += edge_forces(rings, row);
    for (std::size_t a = 0; a < 3; ++a) g[a * rings.unknown_count + k] = sum[a];
  }
}
