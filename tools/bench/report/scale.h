#pragma once

#include <vector>

namespace lapwing::bench {

/// Where values stand along an axis: `from` at pixel `start`, `to` at pixel `end`, either way
/// round.
class Scale {
 public:
  static Scale linear(double from, double to, double start, double end);
  /// By the logarithm; `from` and `to` are above 0.
  static Scale logarithmic(double from, double to, double start, double end);

  double operator()(double value) const;

  /// Round values (1, 2 or 5 times a power of ten) within the axis, at least `gap` pixels apart, as
  /// many as fit.
  std::vector<double> ticks(double gap) const;

 private:
  Scale(bool is_log, double from, double to, double start, double end);
  double place(double value) const;
  std::vector<double> linear_ticks(double gap) const;
  std::vector<double> logarithmic_ticks(double gap) const;

  bool is_log_;
  double from_;
  double to_;
  double start_;
  double end_;
};

}  // namespace lapwing::bench
