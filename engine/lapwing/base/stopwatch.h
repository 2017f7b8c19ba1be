#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lapwing {

/// Wall-clock milliseconds since construction or the last `restart`.
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

/// Milliseconds by stage name, in the order of the stages. Repeated names add up.
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

}  // namespace lapwing
