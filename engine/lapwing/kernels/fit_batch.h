#pragma once

#include <cstddef>
#include <cstdint>

namespace lapwing {

/// Rows that fit_rotations works on at once, one in each lane.
inline constexpr int kFitLanes = 8;

/// What fit_rotations reads, packed for it.
struct FitRings {
  const std::uint32_t* starts;      ///< per row + 1
  const std::uint32_t* neighbours;  ///< per entry
  const double* edges;              ///< per entry: x, y, z of v_j - v_i at rest, w_ij
  const double* displacement;       ///< per vertex: x, y, z, 0
};

/// kFitLanes rows, lane after lane. With x_k = v_k - c at rest and d_k = v'_k - v'_i:
struct alignas(64) FitBatch {
  double H[9][kFitLanes];       ///< sum_k d_k x_k', column after column
  double spread[kFitLanes];     ///< S = sum_k |x_k|^2
  double delta[3][kFitLanes];   ///< L(v)_i
  double moved[3][kFitLanes];   ///< L(v')_i
  double T[9][kFitLanes];       ///< nearest_rotation(H), or the best similarity; as H
  double turned[3][kFitLanes];  ///< T delta - delta
  double energy[kFitLanes];     ///< |moved - T delta|^2
};

/// Fills `batch` for `count` <= kFitLanes rows from `first`. Returns a bit for every lane whose T,
/// and what follows from it, is not to be used, since its H has rank one or none or leaves the
/// rotation nearly free.
using FitBatchFunction = unsigned (*)(const FitRings& rings, std::size_t first, int count,
                                      bool similarity, FitBatch& batch);

/// The fastest one that this processor runs.
FitBatchFunction fit_batch_function();

}  // namespace lapwing
