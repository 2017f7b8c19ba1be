#include "run/meter.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <new>
#include <string>

namespace lapwing::bench {
namespace {

// Counts the calls of operator new on all threads, but not the memory that libraries allocate with
// malloc.
std::atomic<std::uint64_t> allocation_count{0};

void* allocate(std::size_t bytes, std::size_t alignment) {
  allocation_count.fetch_add(1, std::memory_order_relaxed);
  bytes = std::max<std::size_t>(bytes, 1);
  void* const memory =
      alignment <= alignof(std::max_align_t)
          ? std::malloc(bytes)
          // aligned_alloc requires a multiple of the alignment.
          : std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

// Returns the total CPU time of all threads of this process.
double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// Returns the largest resident size of this process since the last `forget_peak_memory`, in bytes.
// Returns 0 if the system does not report it.
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

}  // namespace

struct Meter::Reading {
  double processor_ms;
  std::uint64_t allocations;
  gpu::TransferCounts transfers;
};

Meter::Reading Meter::read() const {
  return {processor_ms(), allocation_count.load(),
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
  // The CPU may have done all the work in the device's memory.
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

// All other forms of new and delete call these.
void* operator new(std::size_t bytes) {
  return lapwing::bench::allocate(bytes, alignof(std::max_align_t));
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return lapwing::bench::allocate(bytes, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
