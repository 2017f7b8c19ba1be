#pragma once

#include "lapwing/elastic/deform_options.h"

namespace lapwing::test {

/// The energy's tangent alone, as it is.
inline DeformOptions linear_options() {
  DeformOptions options;
  options.settle.reset();
  return options;
}

/// The paper's system, equation 10, alone.
inline DeformOptions rsi_options() {
  DeformOptions options = linear_options();
  options.response = LinearResponse::rsi;
  options.weights = LaplacianWeights::uniform;
  return options;
}

}  // namespace lapwing::test
