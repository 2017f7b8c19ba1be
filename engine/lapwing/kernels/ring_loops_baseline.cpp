#include "lapwing/kernels/ring_loops.h"

namespace lapwing {
namespace {

constexpr int kLanes = 2;  // numbers per register

#include "lapwing/kernels/fit_batch.inl"
#include "lapwing/kernels/gradient_rows.inl"

}  // namespace

extern const RingLoops kRingLoopsBaseline;
const RingLoops kRingLoopsBaseline = {fit_batch, finish_batch, gradient};

}  // namespace lapwing
