#pragma once

#include <cstddef>

#include "lapwing/base/instruction_set.h"

namespace lapwing {

/// The inner loops of Lbfgs for one instruction set, each over a chunk of the vectors. Sums are
/// computed in double precision and in a fixed order.
struct HistoryLoops {
  double (*multiply)(const float* difference, const double* x, std::size_t count);
  /// x -= factor difference.
  void (*subtract)(double factor, const float* difference, double* x, std::size_t count);
  double (*dot)(const float* a, const float* b, std::size_t count);
};

/// Returns the loops for `set`, which the CPU must support.
const HistoryLoops& history_loops(InstructionSet set);

}  // namespace lapwing
