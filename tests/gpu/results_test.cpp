#include "lapwing/gpu/results.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/gpu/device_lost.h"

namespace lapwing::gpu {
namespace {

TEST(CheckResult, SuccessesPass) {
  EXPECT_NO_THROW(check_result(VK_SUCCESS, "vkCall", "a device"));
  EXPECT_NO_THROW(check_result(VK_SUBOPTIMAL_KHR, "vkCall", "a device"));
}

TEST(CheckResult, SaysWhatFailedWhere) {
  try {
    check_result(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkCall", "a device");
    ADD_FAILURE() << "accepted";
  } catch (const GpuError& error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("vkCall failed on a device: VK_ERROR_OUT_OF_DEVICE_MEMORY"));
  }
}

TEST(CheckResult, OnlyALostDeviceIsDeviceLost) {
  EXPECT_THROW(check_result(VK_ERROR_DEVICE_LOST, "vkCall", "a device"), DeviceLost);
  try {
    check_result(VK_ERROR_INITIALIZATION_FAILED, "vkCall", "a device");
    ADD_FAILURE() << "accepted";
  } catch (const DeviceLost&) {
    ADD_FAILURE() << "the device is there";
  } catch (const GpuError&) {
    SUCCEED();
  }
}

}  // namespace
}  // namespace lapwing::gpu
