#pragma once

#include <cstddef>

namespace lapwing {

/// The loops of Lbfgs over a chunk of its vectors, for one instruction set. Sums are in double
/// precision and go in a fixed order.
struct HistoryLoops {
  double (*multiply)(const float* difference, const double* x, std::size_t count);
  /// x -= factor difference.
  void (*subtract)(double factor, const float* difference, double* x, std::size_t count);
  double (*dot)(const float* a, const float* b, std::size_t count);
};

/// The fastest ones that this processor runs.
const HistoryLoops& history_loops();

}  // namespace lapwing
