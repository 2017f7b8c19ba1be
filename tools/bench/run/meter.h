#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/gpu/context.h"
#include "report/report.h"

namespace lapwing::bench {

/// A longer run needs no warm-up, because the extra cost of a first run is then small.
inline constexpr double kLongRun_ms = 2000.0;

/// How often a measurement runs its work.
struct Repeats {
  int least = 5;           ///< minimum number of measured runs
  int most = 60;           ///< maximum number of measured runs
  double enough_ms = 500;  ///< time that counted runs should fill, within these two bounds
  int least_long = 3;      ///< replaces `least` if a run takes longer than kLongRun_ms
};

/// Runs `work` once to warm up, then `repeats` times. Returns the times of the repeats.
template <typename Work>
std::vector<double> time_runs(int repeats, Work work) {
  work();
  std::vector<double> milliseconds;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch watch;
    work();
    milliseconds.push_back(watch.elapsed_ms());
  }
  return milliseconds;
}

/// Reads clocks and counters around repeated runs of one piece of work.
class Meter {
 public:
  /// `context` is that of the device, made with ContextOptions::profile; null on the CPU.
  explicit Meter(gpu::Context* context) : context_(context) {}

  /// Runs `work` once to warm up, then as often as `repeats` says. Fills in times, peak memory and
  /// the counts of the last run: allocations by the CPU (a device's driver allocates, too);
  /// dispatches, submissions and bytes uploaded and downloaded on a device. Calls `before` before
  /// every run, outside the measurement.
  void run(Measurement& measurement, const Repeats& repeats, const std::function<void()>& work,
           const std::function<void()>& before = {});

  /// Returns device time and dispatches of every counted run, for each kernel of the last `run`.
  const std::map<std::string, std::vector<gpu::KernelUse>>& kernels() const { return kernels_; }

 private:
  struct Reading;
  Reading read() const;
  void run_once(Measurement& measurement, const std::function<void()>& work);

  gpu::Context* context_;
  std::map<std::string, std::vector<gpu::KernelUse>> kernels_;
};

}  // namespace lapwing::bench
