#pragma once

#include <cstddef>
#include <cstdint>

namespace lapwing {

/// Rows that fit_rotations works on at once, one in each lane.
inline constexpr int kFitLanes = 8;

/// What kFitLanes rows keep from rest, lane after lane. x_k = v_k - c, c the mean over K_i.
struct alignas(64) FitRest {
  double center[3][kFitLanes];  ///< c - v_i
  double delta[3][kFitLanes];   ///< L(v)_i
  double spread[kFitLanes];     ///< S = sum_k |x_k|^2
};

/// One ring entry of each of kFitLanes rows. A row whose ring has no more points to itself, with 0
/// for the numbers.
struct alignas(64) FitEntries {
  double arm[3][kFitLanes];  ///< x_j
  double weight[kFitLanes];  ///< w_ij
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

/// kFitLanes rows, lane after lane. With x_k as above and d_k = v'_k - v'_i:
struct alignas(64) FitBatch {
  double H[9][kFitLanes];       ///< sum_k d_k x_k', column after column
  double moved[3][kFitLanes];   ///< L(v')_i
  double T[9][kFitLanes];       ///< nearest_rotation(H), or the best similarity; as H
  double turned[3][kFitLanes];  ///< T delta - delta
  double energy[kFitLanes];     ///< |moved - T delta|^2
};

/// Fills `batch`. Returns a bit for every lane whose T, and what follows from it, is not to be
/// used, since its H has rank one or none or leaves the rotation nearly free.
using FitBatchFunction = unsigned (*)(const FitRings& rings, bool similarity, FitBatch& batch);

/// The fastest one that this processor runs.
FitBatchFunction fit_batch_function();

}  // namespace lapwing
