#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lapwing/base/cancellation.h"

namespace lapwing {

/// Measures wall-clock time since construction or the last `restart`.
class Stopwatch {
 public:
  double elapsed_ms() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  void restart() { start_ = Clock::now(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Milliseconds by stage name, in the order of the stages. Times of the same name are added.
class StageTimings {
 public:
  void add(std::string_view stage, double milliseconds) {
    for (auto& [name, total] : stages_) {
      if (name == stage) {
        total += milliseconds;
        return;
      }
    }
    stages_.emplace_back(stage, milliseconds);
  }
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

 private:
  std::vector<std::pair<std::string, double>> stages_;
};

/// Runs `body` as a stage: reports it to `progress` and adds its time to `timings`.
template <typename Body>
void stage(const char* name, StageTimings& timings, const Progress& progress, Body body) {
  report_progress(progress, name, 0.0);
  const Stopwatch watch;
  body();
  timings.add(name, watch.elapsed_ms());
}

}  // namespace lapwing
