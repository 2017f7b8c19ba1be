#include "lapwing/settle/tangent_trend.h"

#include <cmath>

namespace lapwing {
namespace {

// What the next tangent takes until the surface has settled.
constexpr double kIterationsByNext = 3.0;

}  // namespace

void TangentTrend::begin(double ms) {
  turn_ms_ = ms;
  count_ = 0;
}

void TangentTrend::add(double step) {
  steps_[count_++ % kSteps] = step;
}

bool TangentTrend::is_next_due(double tolerance, double iteration_ms) const {
  if (count_ < kSteps) return true;
  const double last = steps_[(count_ - 1) % kSteps];
  const double first = steps_[count_ % kSteps];
  // Each step is this many times as long as the one before, in the geometric mean.
  const double ratio = std::pow(last / first, 1.0 / (kSteps - 1));
  if (!(ratio < 1.0)) return true;
  const double left = std::log(tolerance / last) / std::log(ratio);
  return left * iteration_ms > turn_ms_ + kIterationsByNext * iteration_ms;
}

}  // namespace lapwing
