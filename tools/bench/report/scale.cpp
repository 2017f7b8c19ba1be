#include "report/scale.h"

#include <cmath>
#include <initializer_list>

namespace lapwing::bench {
namespace {

// Two values are one if they differ by less, as a share of the axis: rounding must not lose the
// tick at an end.
constexpr double kSlack = 1e-9;

}  // namespace

Scale::Scale(bool is_log, double from, double to, double start, double end)
    : is_log_(is_log), from_(from), to_(to), start_(start), end_(end) {}

Scale Scale::linear(double from, double to, double start, double end) {
  return {false, from, to, start, end};
}

Scale Scale::logarithmic(double from, double to, double start, double end) {
  return {true, from, to, start, end};
}

double Scale::place(double value) const {
  return is_log_ ? std::log(value / from_) / std::log(to_ / from_)
                 : (value - from_) / (to_ - from_);
}

double Scale::operator()(double value) const {
  return std::lerp(start_, end_, place(value));
}

std::vector<double> Scale::ticks(double gap) const {
  return is_log_ ? logarithmic_ticks(gap) : linear_ticks(gap);
}

std::vector<double> Scale::linear_ticks(double gap) const {
  const double least_step = gap * (to_ - from_) / std::abs(end_ - start_);
  double step = std::pow(10.0, std::floor(std::log10(least_step)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    if (factor * step < least_step) continue;
    step *= factor;
    break;
  }
  std::vector<double> ticks;
  const double last = to_ + kSlack * (to_ - from_);
  for (double k = std::ceil(from_ / step - kSlack); k * step <= last; ++k)
    ticks.push_back(k * step);
  return ticks;
}

std::vector<double> Scale::logarithmic_ticks(double gap) const {
  const double decade = std::abs(end_ - start_) * std::log(10.0) / std::log(to_ / from_);
  // The narrowest gaps are from 1 to 2, and of 1 and 3 from 3 to 10.
  std::initializer_list<double> factors{1.0};
  static const auto kAll = {1.0, 2.0, 5.0};
  if (decade * std::log10(2.0) >= gap) factors = kAll;
  const double stride = std::max(1.0, std::ceil(gap / decade));
  std::vector<double> ticks;
  const double first = stride * std::floor(std::log10(from_) / stride);
  for (double power = first; power <= std::log10(to_) + kSlack; power += stride) {
    for (const double factor : factors) {
      const double tick = factor * std::pow(10.0, power);
      if (place(tick) >= -kSlack && place(tick) <= 1.0 + kSlack) ticks.push_back(tick);
    }
  }
  return ticks;
}

}  // namespace lapwing::bench
