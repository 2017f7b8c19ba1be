#pragma once

#include <array>
#include <cstddef>

namespace lapwing {

/// How the steps by one tangent shorten: tells whether the next one, which takes a factorization,
/// would settle the surface sooner than to go on by this one.
class TangentTrend {
 public:
  /// Another tangent was turned, in `ms`.
  void begin(double ms);
  /// What an iteration would move a vertex by at most.
  void add(double step);

  /// Whether the next tangent is due where iterations take `iteration_ms` and end once a step is no
  /// longer than `tolerance`; as long as there are too few steps to tell.
  bool is_next_due(double tolerance, double iteration_ms) const;

 private:
  static constexpr std::size_t kSteps = 4;
  std::array<double, kSteps> steps_{};  ///< the last ones, in a ring
  std::size_t count_ = 0;
  double turn_ms_ = 0.0;
};

}  // namespace lapwing
