#include "support/gpu.h"

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"

namespace lapwing::test {
namespace {

// Makes the test program fail at its end if the validation layers printed messages. This includes
// messages about objects that outlived their context.
class NoValidationMessages : public ::testing::Environment {
 public:
  void TearDown() override {
    EXPECT_EQ(gpu::total_validation_messages(), 0U) << "messages of the validation layers above";
  }
};

const auto* const kEnvironment =
    ::testing::AddGlobalTestEnvironment(new NoValidationMessages);  // owned by GoogleTest

bool find_gpu() {
  try {
    for (const gpu::DeviceDescription& device : gpu::list_devices()) {
      if (device.rejected.empty()) return true;
    }
  } catch (const GpuError& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
  return false;
}

}  // namespace

bool has_gpu() {
  static const bool found = find_gpu();
#ifdef LAPWING_REQUIRE_GPU_TESTS
  EXPECT_TRUE(found) << "configured with LAPWING_REQUIRE_GPU_TESTS, but there is no Vulkan device";
#endif
  return found;
}

}  // namespace lapwing::test
