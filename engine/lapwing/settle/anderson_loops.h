#pragma once

#include <cstddef>

namespace lapwing {

/// The loops of Anderson over a chunk of its vectors, for one instruction set. Sums go in a fixed
/// order.
struct AndersonLoops {
  /// The products of `difference` with `newest` and with `residual`.
  void (*multiply)(const float* difference, const float* newest, const double* residual,
                   std::size_t count, double& with_newest, double& with_residual);
  /// x -= factor difference.
  void (*subtract)(double factor, const float* difference, double* x, std::size_t count);
};

/// The fastest ones that this processor runs.
const AndersonLoops& anderson_loops();

}  // namespace lapwing
