#include "lapwing/gpu/profile.h"

#include <utility>

namespace lapwing::gpu {

void Profile::add(const DeviceUse& use) {
  const std::lock_guard lock(mutex_);
  sum_.submissions += use.submissions;
  sum_.device_ms += use.device_ms;
  for (const auto& [name, kernel] : use.kernels) {
    KernelUse& sum = sum_.kernels[name];
    sum.dispatches += kernel.dispatches;
    sum.device_ms += kernel.device_ms;
  }
}

DeviceUse Profile::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(sum_, {});
}

}  // namespace lapwing::gpu
