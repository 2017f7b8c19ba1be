#include "lapwing/kernels/ring_loops.h"

namespace lapwing {
namespace {

constexpr int kLanes = 8;  // numbers per register

#include "lapwing/kernels/ring_loops.inl"

}  // namespace

extern const RingLoops kRingLoopsAvx512;
const RingLoops kRingLoopsAvx512 = {fit_batch, finish_batch, gradient};

}  // namespace lapwing
