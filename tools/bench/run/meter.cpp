#include "run/meter.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>

#include "run/allocations.h"

namespace lapwing::bench {

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

std::uint64_t peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return 1024 * std::stoull(line.substr(6));
  }
  return 0;
}

void forget_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

struct Meter::Reading {
  double processor_ms;
  std::uint64_t allocations;
  gpu::TransferCounts transfers;
};

Meter::Reading Meter::read() const {
  return {processor_ms(), allocation_count(),
          context_ != nullptr ? context_->transfers() : gpu::TransferCounts{}};
}

void Meter::run_once(Measurement& measurement, const std::function<void()>& work) {
  if (context_ != nullptr) context_->profile()->take();
  const Reading before = read();
  const Stopwatch watch;
  work();
  const double wall_ms = watch.elapsed_ms();
  const Reading after = read();
  measurement.wall_ms.push_back(wall_ms);
  measurement.cpu_ms.push_back(after.processor_ms - before.processor_ms);
  if (context_ == nullptr) {
    measurement.counts["allocations"] = after.allocations - before.allocations;
    return;
  }
  const gpu::DeviceUse use = context_->profile()->take();
  // The processor may have done all the work itself, in the device's memory.
  if (use.submissions > 0) measurement.device_ms.push_back(use.device_ms);
  measurement.counts["submissions"] = use.submissions;
  std::uint64_t dispatches = 0;
  for (const auto& [name, kernel] : use.kernels) {
    dispatches += kernel.dispatches;
    kernels_[name].push_back(kernel);
  }
  measurement.counts["dispatches"] = dispatches;
  measurement.counts["uploaded"] = after.transfers.uploaded - before.transfers.uploaded;
  measurement.counts["downloaded"] = after.transfers.downloaded - before.transfers.downloaded;
}

void Meter::run(Measurement& measurement, const Repeats& repeats, const std::function<void()>& work,
                const std::function<void()>& before) {
  const auto once = [&] {
    if (before) before();
    run_once(measurement, work);
  };
  kernels_.clear();
  forget_peak_memory();
  once();
  const double first_ms = measurement.wall_ms.front();
  int left = std::min(repeats.least, repeats.least_long) - 1;
  if (first_ms < kLongRun_ms) {
    measurement.wall_ms.clear();
    measurement.cpu_ms.clear();
    measurement.device_ms.clear();
    kernels_.clear();
    const double wanted = std::ceil(repeats.enough_ms / std::max(first_ms, 1e-3));
    left = static_cast<int>(
        std::clamp(wanted, static_cast<double>(repeats.least), static_cast<double>(repeats.most)));
  }
  for (; left > 0; --left) once();
  measurement.peak_bytes = peak_memory();
}

}  // namespace lapwing::bench
