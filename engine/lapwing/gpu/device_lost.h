#pragma once

#include "lapwing/base/errors.h"

namespace lapwing::gpu {

/// The driver lost the device. Everything made from its context can only be destroyed. A new
/// context may open the device again.
class DeviceLost : public GpuError {
 public:
  using GpuError::GpuError;
};

}  // namespace lapwing::gpu
