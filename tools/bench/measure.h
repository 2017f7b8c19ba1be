#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "lapwing/base/stopwatch.h"

namespace lapwing::bench {

/// Milliseconds of repeated runs of one thing.
struct Samples {
  std::vector<double> milliseconds;

  double median() const { return at(0.5); }
  double min() const { return at(0.0); }
  double max() const { return at(1.0); }

 private:
  double at(double share) const {
    std::vector<double> sorted = milliseconds;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
};

/// Runs `body` once to warm up, then `repeats` times.
template <typename Body>
Samples measure(int repeats, Body body) {
  body();
  Samples samples;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    body();
    samples.milliseconds.push_back(watch.elapsed_ms());
  }
  return samples;
}

}  // namespace lapwing::bench
