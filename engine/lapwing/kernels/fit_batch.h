#pragma once

#include <cstddef>
#include <cstdint>

namespace lapwing {

/// Rows that fit_rotations works on at once, one in each lane.
inline constexpr int kFitLanes = 8;

/// What kFitLanes rows keep from rest, lane after lane.
struct alignas(64) FitRest {
  double delta[3][kFitLanes];  ///< L(v)_i
  double weight[kFitLanes];    ///< om_i
  double scale[kFitLanes];     ///< s_i
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
  const double* displacement;  ///< per vertex: x, y, z, 0
};

/// kFitLanes rows, lane after lane.
struct alignas(64) FitBatch {
  double C[9][kFitLanes];         ///< as in RingRotations::fit_rotations, column after column
  double moved[3][kFitLanes];     ///< L(v')_i
  double T[9][kFitLanes];         ///< s_i R_i; as C
  double residual[3][kFitLanes];  ///< om_i (moved - T delta)
  double energy[kFitLanes];
};

/// Fills `batch`. Returns a bit for every lane whose T, and what follows from it, is not to be
/// used, since its C has rank one or none or leaves the rotation nearly free.
using FitBatchFunction = unsigned (*)(const FitRings& rings, FitBatch& batch);

/// The same for lanes whose T is given: residual and energy.
using FinishBatchFunction = void (*)(const FitRings& rings, FitBatch& batch);

struct FitBatchFunctions {
  FitBatchFunction fit;
  FinishBatchFunction finish;
};

/// The fastest ones that this processor runs.
const FitBatchFunctions& fit_batch_functions();

}  // namespace lapwing
