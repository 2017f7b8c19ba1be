#pragma once

namespace lapwing {

struct SettleOptions {
  /// Settled when the next step would move no vertex farther, in mean edge lengths.
  double tolerance = 1e-4;
  int max_iterations = 200;

  bool operator==(const SettleOptions&) const = default;
};

}  // namespace lapwing
