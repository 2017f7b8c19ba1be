#include "lapwing/kernels/fit_batch.h"

namespace lapwing {
namespace {

#include "lapwing/kernels/fit_batch.inl"

}  // namespace

extern const FitBatchFunction kFitBatchAvx512;
const FitBatchFunction kFitBatchAvx512 = fit_batch;

}  // namespace lapwing
