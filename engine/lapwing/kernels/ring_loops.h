#pragma once

#include <cstddef>
#include <cstdint>

#include "lapwing/base/instruction_set.h"

namespace lapwing {

/// Number of rows that fit_rotations computes at once, one in each lane.
inline constexpr int kFitLanes = 8;

/// A vector that fits one register load.
struct alignas(32) PaddedVector {
  double xyz0[4] = {};
};

/// T - I of a ring, which keeps the digits of small turns; column-major.
struct PaddedTurn {
  PaddedVector column[3];
};

/// The rest shape of kFitLanes rows, lane after lane.
struct alignas(64) FitRest {
  double delta[3][kFitLanes];  ///< L(v)_i
  double weight[kFitLanes];    ///< om_i
};

/// Rest stretch of kFitLanes rows: xx, yy, zz, yz, xz, xy, lane after lane.
struct alignas(64) FitStretch {
  double S[6][kFitLanes];
};

/// One ring entry of each of kFitLanes rows. If a row has no more entries, it points to itself with
/// numbers 0.
struct alignas(64) FitEntries {
  double edge[3][kFitLanes];    ///< v_j - v_i
  double weight[kFitLanes];     ///< w_ij
  double stiffness[kFitLanes];  ///< k_ij
  std::uint32_t neighbour[kFitLanes];
};

/// Input of fit_rotations for kFitLanes rows.
struct FitRings {
  const FitRest& rest;
  const FitEntries* entries;
  std::size_t entry_count;  ///< of the longest ring
  std::uint32_t first_row;
  const PaddedVector* displacement;  ///< per vertex
  const FitStretch* stretch;         ///< null for the identity
};

/// Results of fit_rotations for kFitLanes rows, lane after lane.
struct alignas(64) FitBatch {
  double C[9][kFitLanes];         ///< as in RingRotations::fit_rotations, column after column
  double moved[3][kFitLanes];     ///< L(v')_i
  double T[9][kFitLanes];         ///< R_i S_i; as C
  double residual[3][kFitLanes];  ///< om_i (moved - T delta)
  double energy[kFitLanes];
};

/// Input of energy_gradient: RegionRings, and the results of the last fit.
struct GradientRings {
  const std::uint32_t* starts;
  const std::uint32_t* neighbours;
  const double* edges;  ///< 3 numbers per entry
  const double* reverse_weights;
  const double* stiffness;  ///< null if there is none
  std::size_t row_count;
  const std::uint32_t* unknown_rows;
  std::size_t unknown_count;
  const PaddedVector* displacement;  ///< per vertex
  const PaddedVector* residuals;     ///< per vertex; 0 for vertices that are not rows
  const PaddedTurn* turns;           ///< likewise
};

/// The inner loops of fits and gradients, for one instruction set.
struct RingLoops {
  /// Fills `batch`. Returns a bit for every lane whose T, and what follows from it, is invalid: its
  /// C has at most rank one, or leaves the rotation nearly free.
  unsigned (*fit)(const FitRings& rings, FitBatch& batch);
  /// Computes residual and energy of all lanes for a given T.
  void (*finish)(const FitRings& rings, FitBatch& batch);
  /// Computes the gradient by the unknowns [first, last), at their places in x of all unknowns, y
  /// and z.
  void (*gradient)(const GradientRings& rings, std::size_t first, std::size_t last, double* g);
};

/// Returns the loops for `set`, which must be available.
const RingLoops& ring_loops(InstructionSet set);

}  // namespace lapwing
