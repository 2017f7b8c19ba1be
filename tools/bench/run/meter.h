#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/gpu/context.h"
#include "report/report.h"

namespace lapwing::bench {

/// A run that takes longer than this is its own warm-up: what first runs lose is small beside it.
inline constexpr double kLongRun_ms = 2000.0;

/// How often something is run.
struct Repeats {
  int least = 5;           ///< counted runs, however long they take
  int most = 60;           ///< counted runs, however short
  double enough_ms = 500;  ///< all counted runs together, between those two
  int least_long = 3;      ///< in place of `least` for work that takes longer than kLongRun_ms
};

/// Processor time of all threads of this process, in milliseconds.
double processor_ms();

/// Largest resident size of this process since the last `forget_peak_memory`, in bytes; 0 where the
/// system does not tell.
std::uint64_t peak_memory();
void forget_peak_memory();

/// Reads clocks and counters around repeated runs of one piece of work.
class Meter {
 public:
  /// `context`: that of the device that works, made with ContextOptions::profile; or null.
  explicit Meter(gpu::Context* context) : context_(context) {}

  /// Runs `work` once to warm up, then as often as `repeats` says, and fills in times, peak memory
  /// and what is counted by itself, of the last run: allocations on the processor (a device's
  /// driver allocates too); dispatches, submissions and bytes uploaded and downloaded on a device.
  /// `before` is called before every run and belongs to none.
  void run(Measurement& measurement, const Repeats& repeats, const std::function<void()>& work,
           const std::function<void()>& before = {});

  /// Of each kernel that ran in the last `run`: device time and dispatches of every counted run.
  const std::map<std::string, std::vector<gpu::KernelUse>>& kernels() const { return kernels_; }

 private:
  struct Reading;
  Reading read() const;
  void run_once(Measurement& measurement, const std::function<void()>& work);

  gpu::Context* context_;
  std::map<std::string, std::vector<gpu::KernelUse>> kernels_;
};

}  // namespace lapwing::bench
