#include "lapwing/kernels/fit_batch.h"

namespace lapwing {
namespace {

#include "lapwing/kernels/fit_batch.inl"

}  // namespace

extern const FitBatchFunction kFitBatchBaseline;
const FitBatchFunction kFitBatchBaseline = fit_batch;

}  // namespace lapwing
