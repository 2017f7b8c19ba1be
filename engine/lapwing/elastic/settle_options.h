#pragma once

namespace lapwing {

struct SettleOptions {
  /// The surface is settled if the next step moves no vertex farther than this, in mean edge
  /// lengths.
  double tolerance = 1e-4;
  int max_iterations = 200;

  bool operator==(const SettleOptions&) const = default;
};

}  // namespace lapwing
