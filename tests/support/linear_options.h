#pragma once

#include "lapwing/elastic/deform_options.h"

namespace lapwing::test {

/// Returns options for a linear response without settling.
inline DeformOptions linear_options() {
  DeformOptions options;
  options.settle.reset();
  return options;
}

/// Returns options for the paper's system (eq. 10) without settling.
inline DeformOptions rsi_options() {
  DeformOptions options = linear_options();
  options.response = LinearResponse::rsi;
  options.constraint_weight = 1.0;
  options.weights = LaplacianWeights::uniform;
  return options;
}

}  // namespace lapwing::test
