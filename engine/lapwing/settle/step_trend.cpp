#include "lapwing/settle/step_trend.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lapwing {

void StepTrend::add(double step) {
  steps_[count_++ % kSteps] = step;
}

std::optional<double> StepTrend::iterations_left(double tolerance) const {
  if (count_ < kSteps) return std::nullopt;
  const double last = steps_[(count_ - 1) % kSteps];
  const double first = steps_[count_ % kSteps];
  // Each step is this many times as long as the one before, in the geometric mean.
  const double ratio = std::pow(last / first, 1.0 / (kSteps - 1));
  if (!(ratio < 1.0)) return std::numeric_limits<double>::infinity();
  return std::max(0.0, std::log(tolerance / last) / std::log(ratio));
}

}  // namespace lapwing
