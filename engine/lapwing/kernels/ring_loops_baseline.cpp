#include "lapwing/kernels/ring_loops.h"

namespace lapwing {
namespace {

constexpr int kLanes = 2;  // numbers per register

#include "lapwing/kernels/ring_loops.inl"

}  // namespace

extern const RingLoops kRingLoopsBaseline;
const RingLoops kRingLoopsBaseline = {fit_batch, finish_batch, gradient};

}  // namespace lapwing
