#pragma once

#include <cstddef>

#include "lapwing/base/instruction_set.h"

namespace lapwing {

/// The loops of Lbfgs over a chunk of its vectors, for one instruction set. Sums are in double
/// precision and go in a fixed order.
struct HistoryLoops {
  double (*multiply)(const float* difference, const double* x, std::size_t count);
  /// x -= factor difference.
  void (*subtract)(double factor, const float* difference, double* x, std::size_t count);
  double (*dot)(const float* a, const float* b, std::size_t count);
};

/// `set` must be available.
const HistoryLoops& history_loops(InstructionSet set);

}  // namespace lapwing
