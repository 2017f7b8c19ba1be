#pragma once

#include <memory>

#include "lapwing/gpu/context.h"

namespace lapwing::test {

/// Whether there is a Vulkan device to test on. Without one a test may only skip, and where the
/// build was configured with LAPWING_REQUIRE_GPU_TESTS it fails instead.
bool has_gpu();

}  // namespace lapwing::test

/// First line of a test that needs a device.
#define LAPWING_NEEDS_GPU() \
  if (!::lapwing::test::has_gpu()) GTEST_SKIP() << "no Vulkan device"
