#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/solve/block_matrix.h"

namespace lapwing::bench {

/// Median of `repeats` runs of `body`, in milliseconds.
template <typename Body>
double median_ms(int repeats, Body body) {
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    body();
    times.push_back(watch.elapsed_ms());
  }
  std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
  return times[static_cast<std::size_t>(repeats / 2)];
}

/// `count` numbers between -1 and 1, the same each time.
std::vector<double> right_hand_sides(std::size_t count);

/// |A x - b| / (|A| |x| + |b|) in the maximum norm.
double normwise_backward_error(const BlockMatrix& A, std::span<const double> x,
                               std::span<const double> b);

}  // namespace lapwing::bench
