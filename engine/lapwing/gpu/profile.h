#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace lapwing::gpu {

struct KernelUse {
  std::uint64_t dispatches = 0;
  double device_ms = 0.0;
};

/// The work of a device. Times are measured by the device's clock, and are 0 on a device without
/// timestamps.
struct DeviceUse {
  std::uint64_t submissions = 0;
  double device_ms = 0.0;                    ///< sum of the durations of all submissions
  std::map<std::string, KernelUse> kernels;  ///< indexed by Kernel::name
};

/// Sums the work of a context's command lists. A submission is included when the host has waited
/// for it. Thread-safe.
class Profile {
 public:
  void add(const DeviceUse& use) {
    const std::lock_guard lock(mutex_);
    sum_.submissions += use.submissions;
    sum_.device_ms += use.device_ms;
    for (const auto& [name, kernel] : use.kernels) {
      KernelUse& sum = sum_.kernels[name];
      sum.dispatches += kernel.dispatches;
      sum.device_ms += kernel.device_ms;
    }
  }
  /// Returns the work since the last call.
  DeviceUse take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(sum_, {});
  }

 private:
  std::mutex mutex_;
  DeviceUse sum_;
};

}  // namespace lapwing::gpu
