#pragma once

#include <cstddef>
#include <cstdint>

#include "lapwing/base/instruction_set.h"

namespace lapwing {

/// Rows that fit_rotations works on at once, one in each lane.
inline constexpr int kFitLanes = 8;

/// A vector as one load of a register.
struct alignas(32) PaddedVector {
  double xyz0[4] = {};
};

/// How a ring is stretched and turned: T - I, which keeps the digits of small turns; column after
/// column.
struct PaddedTurn {
  PaddedVector column[3];
};

/// What kFitLanes rows keep from rest, lane after lane.
struct alignas(64) FitRest {
  double delta[3][kFitLanes];  ///< L(v)_i
  double weight[kFitLanes];    ///< om_i
};

/// Rest stretch of kFitLanes rows: xx, yy, zz, yz, xz, xy, lane after lane.
struct alignas(64) FitStretch {
  double S[6][kFitLanes];
};

/// One ring entry of each of kFitLanes rows. A row whose ring has no more points to itself, with 0
/// for the numbers.
struct alignas(64) FitEntries {
  double edge[3][kFitLanes];    ///< v_j - v_i
  double weight[kFitLanes];     ///< w_ij
  double stiffness[kFitLanes];  ///< k_ij
  std::uint32_t neighbour[kFitLanes];
};

/// What fit_rotations reads of kFitLanes rows.
struct FitRings {
  const FitRest& rest;
  const FitEntries* entries;
  std::size_t entry_count;  ///< as many as the longest ring has
  std::uint32_t first_row;
  const PaddedVector* displacement;  ///< per vertex
  const FitStretch* stretch;         ///< null for the identity
};

/// kFitLanes rows, lane after lane.
struct alignas(64) FitBatch {
  double C[9][kFitLanes];         ///< as in RingRotations::fit_rotations, column after column
  double moved[3][kFitLanes];     ///< L(v')_i
  double T[9][kFitLanes];         ///< R_i S_i; as C
  double residual[3][kFitLanes];  ///< om_i (moved - T delta)
  double energy[kFitLanes];
};

/// What energy_gradient reads: RegionRings, and what the last fit left.
struct GradientRings {
  const std::uint32_t* starts;
  const std::uint32_t* neighbours;
  const double* edges;  ///< 3 numbers per entry
  const double* reverse_weights;
  const double* stiffness;  ///< null where there is none
  std::size_t row_count;
  const std::uint32_t* unknown_rows;
  std::size_t unknown_count;
  const PaddedVector* displacement;  ///< per vertex
  const PaddedVector* residuals;     ///< per vertex; 0 for one that is no row
  const PaddedTurn* turns;           ///< likewise
};

/// What fits and gradients do most, for one instruction set.
struct RingLoops {
  /// Fills `batch`. Returns a bit for every lane whose T, and what follows from it, is not to be
  /// used, since its C has rank one or none or leaves the rotation nearly free.
  unsigned (*fit)(const FitRings& rings, FitBatch& batch);
  /// The same for lanes whose T is given: residual and energy.
  void (*finish)(const FitRings& rings, FitBatch& batch);
  /// The gradient by the unknowns [first, last), in its place among x of all unknowns, y and z.
  void (*gradient)(const GradientRings& rings, std::size_t first, std::size_t last, double* g);
};

/// `set` is to be among the available ones.
const RingLoops& ring_loops(InstructionSet set);

}  // namespace lapwing
