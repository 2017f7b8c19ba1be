#pragma once

#include "lapwing/laplacian/weights.h"

namespace lapwing {

/// What happens to the size of details where the surface is scaled (paper, section 3.1).
enum class Details {
  preserve,  ///< delta keeps its length: T_i is a rotation
  follow,    ///< delta scales with its ring: T_i is the best similarity
};

struct SettleOptions {
  LaplacianWeights weights = LaplacianWeights::uniform;
  Details details = Details::preserve;
  /// mu: how strongly edges keep their length, from 0 (the paper's energy) to 1 and above (as rigid
  /// as possible, details crumple). Not negative.
  double stretch_resistance = 0.0;
  /// Settled when no vertex would move farther in one more iteration, in mean edge lengths.
  double tolerance = 1e-4;
  int max_iterations = 100;
  bool accelerate = true;  ///< Anderson acceleration; off to compare with

  bool operator==(const SettleOptions&) const = default;
};

}  // namespace lapwing
