#pragma once

#include <memory>

#include "lapwing/gpu/context.h"

namespace lapwing::test {

/// Returns whether there is a Vulkan device. Without one, tests skip. If the build was configured
/// with LAPWING_REQUIRE_GPU_TESTS, they fail instead.
bool has_gpu();

}  // namespace lapwing::test

/// First line of a test that needs a device.
#define LAPWING_NEEDS_GPU() \
  if (!::lapwing::test::has_gpu()) GTEST_SKIP() << "no Vulkan device"
