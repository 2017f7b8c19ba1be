#include "lapwing/kernels/ring_loops.h"

namespace lapwing {
namespace {

constexpr int kLanes = 8;  // numbers per register

#include "lapwing/kernels/fit_batch.inl"
#include "lapwing/kernels/gradient_rows.inl"

}  // namespace

extern const RingLoops kRingLoopsAvx512;
const RingLoops kRingLoopsAvx512 = {fit_batch, finish_batch, gradient};

}  // namespace lapwing
