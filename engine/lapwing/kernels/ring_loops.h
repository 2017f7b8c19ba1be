#pragma once

#include <cstddef>
#include <cstdint>

#include "lapwing/base/instruction_set.h"

namespace lapwing {

/// Number of rows that fit_rotations computes at once, one in each lane.
inline constexpr int kFitLanes = 8;

/// A vector padded to four numbers, so that a single instruction can load it.
struct alignas(32) PaddedVector {
  double xyz0[4] = {};
};

/// T - I of a ring, column-major. Unlike T, it represents small turns accurately.
struct PaddedTurn {
  PaddedVector column[3];
};

/// The rest shape of kFitLanes rows, one in each lane.
struct alignas(64) FitRest {
  double delta[3][kFitLanes];  ///< L(v)_i
  double weight[kFitLanes];    ///< om_i
};

/// The rest stretch of kFitLanes rows, one in each lane: xx, yy, zz, yz, xz, xy.
struct alignas(64) FitStretch {
  double S[6][kFitLanes];
};

/// One ring entry of each of kFitLanes rows. A row with fewer entries refers to itself, with edge,
/// weight and stiffness 0.
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
  std::size_t entry_count;  ///< number of entries of the longest ring
  std::uint32_t first_row;
  const PaddedVector* displacement;  ///< per vertex
  const FitStretch* stretch;         ///< null: all S_i are the identity
};

/// Results of fit_rotations for kFitLanes rows, one in each lane.
struct alignas(64) FitBatch {
  double C[9][kFitLanes];         ///< C_i S_i of RingRotations::fit_rotations, column-major
  double moved[3][kFitLanes];     ///< L(v')_i
  double T[9][kFitLanes];         ///< R_i S_i, column-major
  double residual[3][kFitLanes];  ///< om_i (moved - T delta)
  double energy[kFitLanes];
};

/// Input of energy_gradient: the arrays of RegionRings, and the results of the last fit.
struct GradientRings {
  const std::uint32_t* starts;
  const std::uint32_t* neighbours;
  const double* edges;  ///< 3 numbers per entry
  const double* reverse_weights;
  const double* stiffness;  ///< null: all k_ij are 0
  std::size_t row_count;
  const std::uint32_t* unknown_rows;
  std::size_t unknown_count;
  const PaddedVector* displacement;  ///< per vertex
  const PaddedVector* residuals;     ///< per vertex; 0 for vertices that are not rows
  const PaddedTurn* turns;           ///< per vertex; 0 for vertices that are not rows
};

/// The inner loops of CpuRingRotations for one instruction set.
struct RingLoops {
  /// Computes `batch`. Returns a bit mask of the lanes whose T, residual and energy are invalid,
  /// because C has at most rank one or hardly determines the rotation.
  unsigned (*fit)(const FitRings& rings, FitBatch& batch);
  /// Computes residual and energy of all lanes for a given T.
  void (*finish)(const FitRings& rings, FitBatch& batch);
  /// Computes the gradient with respect to the unknowns [first, last). `g` contains x of all
  /// unknowns, then y, then z.
  void (*gradient)(const GradientRings& rings, std::size_t first, std::size_t last, double* g);
};

/// Returns the loops for `set`, which the CPU must support.
const RingLoops& ring_loops(InstructionSet set);

}  // namespace lapwing
