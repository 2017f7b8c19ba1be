#pragma once

#include "lapwing/base/errors.h"

namespace lapwing::gpu {

/// The driver gave the device up: nothing made from its context can be used any more, only
/// destroyed. A new context may open the device again.
class DeviceLost : public GpuError {
 public:
  using GpuError::GpuError;
};

}  // namespace lapwing::gpu
