#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace lapwing::gpu {

/// Work of one kernel.
struct KernelUse {
  std::uint64_t dispatches = 0;
  double device_ms = 0.0;
};

/// Work of a device. Times are by its own clock, 0 on a device without timestamps.
struct DeviceUse {
  std::uint64_t submissions = 0;
  double device_ms = 0.0;                    ///< sum over submissions, each from begin to end
  std::map<std::string, KernelUse> kernels;  ///< by Kernel::name
};

/// Sums the work of a context's command lists. Each submission counts once it has been waited for.
/// Thread-safe.
class Profile {
 public:
  void add(const DeviceUse& use);
  /// Returns the work since the last call.
  DeviceUse take();

 private:
  std::mutex mutex_;
  DeviceUse sum_;
};

}  // namespace lapwing::gpu
