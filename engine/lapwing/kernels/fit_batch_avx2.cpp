#include "lapwing/kernels/fit_batch.h"

namespace lapwing {
namespace {

#include "lapwing/kernels/fit_batch.inl"

}  // namespace

extern const FitBatchFunctions kFitBatchAvx2;
const FitBatchFunctions kFitBatchAvx2 = {fit_batch, finish_batch};

}  // namespace lapwing
