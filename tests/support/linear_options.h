#pragma once

#include "lapwing/elastic/deform_options.h"

namespace lapwing::test {

/// Returns the options for the linear response alone, without settling.
inline DeformOptions linear_options() {
  DeformOptions options;
  options.settle.reset();
  return options;
}

/// Returns the options for the paper's system (eq. 10) alone.
inline DeformOptions rsi_options() {
  DeformOptions options = linear_options();
  options.response = LinearResponse::rsi;
  options.constraint_weight = 1.0;
  options.weights = LaplacianWeights::uniform;
  return options;
}

}  // namespace lapwing::test
