#include "lapwing/kernels/ring_loops.h"

namespace lapwing {
namespace {

constexpr int kLanes = 4;  // numbers per register

#include "lapwing/kernels/ring_loops.inl"

}  // namespace

extern const RingLoops kRingLoopsAvx2;
const RingLoops kRingLoopsAvx2 = {fit_batch, finish_batch, gradient};

}  // namespace lapwing
