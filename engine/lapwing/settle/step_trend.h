#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace lapwing {

/// How the steps of iterations shorten: tells whether what would shorten them faster pays.
class StepTrend {
 public:
  /// Steps go by another Hessian from here on.
  void begin() { count_ = 0; }
  /// What an iteration would move a vertex by at most.
  void add(double step);

  /// Iterations like the last ones until a step is no longer than `tolerance`: infinite where steps
  /// do not shorten, nothing as long as there are too few to tell.
  std::optional<double> iterations_left(double tolerance) const;

 private:
  static constexpr std::size_t kSteps = 4;
  std::array<double, kSteps> steps_{};  ///< the last ones, in a ring
  std::size_t count_ = 0;
};

}  // namespace lapwing
