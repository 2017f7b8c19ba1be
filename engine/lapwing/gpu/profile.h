#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace lapwing::gpu {

/// What one kernel did.
struct KernelUse {
  std::uint64_t dispatches = 0;
  double device_ms = 0.0;
};

/// What a device did. Times are by its own clock, 0 on a device without timestamps.
struct DeviceUse {
  std::uint64_t submissions = 0;
  double device_ms = 0.0;                    ///< of all submissions, each from begin to end
  std::map<std::string, KernelUse> kernels;  ///< by Kernel::name
};

/// Adds up what the command lists of a context do, each submission once it has been waited for. For
/// several threads.
class Profile {
 public:
  void add(const DeviceUse& use);
  /// All since the last call.
  DeviceUse take();

 private:
  std::mutex mutex_;
  DeviceUse sum_;
};

}  // namespace lapwing::gpu
