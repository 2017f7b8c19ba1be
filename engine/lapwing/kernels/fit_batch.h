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

/// Sums over the rings of kFitLanes rows, and the rotations they give; lane after lane. With
/// x_k = v_k - c at rest and d_k = v'_k - v'_i:
struct alignas(64) FitBatch {
  double H[9][kFitLanes];      ///< sum_k d_k x_k', column after column
  double R[9][kFitLanes];      ///< nearest_rotation(H), column after column
  double spread[kFitLanes];    ///< S = sum_k |x_k|^2
  double delta[3][kFitLanes];  ///< L(v)_i
  double moved[3][kFitLanes];  ///< L(v')_i
};

/// Fills `batch` for `count` <= kFitLanes rows from `first`. Returns a bit for every lane whose R
/// is not to be used, since its H has rank one or none or leaves R nearly free.
using FitBatchFunction = unsigned (*)(const FitRings& rings, std::size_t first, int count,
                                      FitBatch& batch);

/// The fastest one that this processor runs.
FitBatchFunction fit_batch_function();

}  // namespace lapwing
