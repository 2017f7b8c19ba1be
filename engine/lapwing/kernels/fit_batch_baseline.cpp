#include "lapwing/kernels/fit_batch.h"

namespace lapwing {
namespace {

#include "lapwing/kernels/fit_batch.inl"

}  // namespace

extern const FitBatchFunctions kFitBatchBaseline;
const FitBatchFunctions kFitBatchBaseline = {fit_batch, finish_batch};

}  // namespace lapwing
