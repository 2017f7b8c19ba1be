#pragma once

#include <cstddef>
#include <optional>

#include "lapwing/laplacian/weights.h"
#include "lapwing/settle/settle_options.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// The rest is for the response, the device's copy of it, and whoever else runs.
inline constexpr double kMemoryShare = 0.75;

struct DeformOptions {
  LaplacianWeights weights = LaplacianWeights::uniform;
  /// How strongly handle and belt hold (eq. 5 has 1). Positive. Has no effect on hard constraints.
  double constraint_weight = 1.0;
  /// Handle and belt vertices go exactly where they should, rather than in the least squares.
  bool hard = false;
  SolverKind solver = SolverKind::automatic;
  /// The 3n x 3n system may take this much memory; 0: kMemoryShare of what is there when it is
  /// prepared. Where it needs more, settling does without it, from where a DragPreview is.
  std::size_t memory_limit_bytes = 0;
  /// Settle what `solve` returns, so that details survive large rotations; without it the result is
  /// right for small angles only.
  std::optional<SettleOptions> settle;
};

}  // namespace lapwing
