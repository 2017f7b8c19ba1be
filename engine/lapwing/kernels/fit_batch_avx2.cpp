#include "lapwing/kernels/fit_batch.h"

namespace lapwing {
namespace {

#include "lapwing/kernels/fit_batch.inl"

}  // namespace

extern const FitBatchFunction kFitBatchAvx2;
const FitBatchFunction kFitBatchAvx2 = fit_batch;

}  // namespace lapwing
