#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <sys/mman.h>
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

/// Runs `body` `repeats` times.
template <typename Body>
Samples measure_cold(int repeats, Body body) {
  Samples samples;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    body();
    samples.milliseconds.push_back(watch.elapsed_ms());
  }
  return samples;
}

/// Runs `body` once to warm up, then `repeats` times.
template <typename Body>
Samples measure(int repeats, Body body) {
  body();
  return measure_cold(repeats, body);
}

/// Allocates, touches and frees `bytes` of memory, untimed, before a run that allocates as much. A
/// virtual machine returns freed memory to its host, and getting it back costs far more than a page
/// fault. Otherwise the first measurement would pay for all.
inline void touch_memory(std::size_t bytes) {
  void* const memory =
      mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;
  madvise(memory, bytes, MADV_HUGEPAGE);
  std::memset(memory, 1, bytes);
  munmap(memory, bytes);
}

}  // namespace lapwing::bench
