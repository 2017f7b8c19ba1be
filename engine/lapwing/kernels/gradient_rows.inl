// The inner loop of energy_gradient (kernels/energy_gradient.cpp). Included after fit_batch.inl.

// Arithmetic on it is as good if a register holds only half of it.
typedef double Padded __attribute__((vector_size(sizeof(PaddedVector)), may_alias));

LAPWING_INLINE const Padded& padded(const PaddedVector& vector) {
  return *reinterpret_cast<const Padded*>(vector.xyz0);
}

LAPWING_INLINE Padded turned(const PaddedTurn& turn, double x, double y, double z) {
  return padded(turn.column[0]) * x + padded(turn.column[1]) * y + padded(turn.column[2]) * z;
}

// Returns the edge terms of a row's gradient. Edges go from the row to its neighbours, against the
// sense of the contract; both signs cancel.
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
