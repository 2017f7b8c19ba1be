#pragma once

#include <optional>

#include "lapwing/laplacian/weights.h"
#include "lapwing/settle/settle_options.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

struct DeformOptions {
  LaplacianWeights weights = LaplacianWeights::uniform;
  /// How strongly handle and belt hold (eq. 5 has 1). Positive. Has no effect on hard constraints.
  double constraint_weight = 1.0;
  /// Handle and belt vertices go exactly where they should, rather than in the least squares.
  bool hard = false;
  SolverKind solver = SolverKind::automatic;
  /// Settle what `solve` returns, so that details survive large rotations; without it the result is
  /// right for small angles only.
  std::optional<SettleOptions> settle;
};

}  // namespace lapwing
