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

TEST(ResultName, IsThatOfTheSpecificationOrElseTheNumber) {
#define LAPWING_EXPECT_NAME(name) EXPECT_EQ(result_name(name), #name)
  LAPWING_EXPECT_NAME(VK_SUCCESS);
  LAPWING_EXPECT_NAME(VK_NOT_READY);
  LAPWING_EXPECT_NAME(VK_TIMEOUT);
  LAPWING_EXPECT_NAME(VK_INCOMPLETE);
  LAPWING_EXPECT_NAME(VK_ERROR_MEMORY_MAP_FAILED);
  LAPWING_EXPECT_NAME(VK_ERROR_LAYER_NOT_PRESENT);
  LAPWING_EXPECT_NAME(VK_ERROR_EXTENSION_NOT_PRESENT);
  LAPWING_EXPECT_NAME(VK_ERROR_FEATURE_NOT_PRESENT);
  LAPWING_EXPECT_NAME(VK_ERROR_INCOMPATIBLE_DRIVER);
  LAPWING_EXPECT_NAME(VK_ERROR_TOO_MANY_OBJECTS);
  LAPWING_EXPECT_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED);
  LAPWING_EXPECT_NAME(VK_ERROR_SURFACE_LOST_KHR);
  LAPWING_EXPECT_NAME(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR);
  LAPWING_EXPECT_NAME(VK_ERROR_OUT_OF_DATE_KHR);
#undef LAPWING_EXPECT_NAME
  EXPECT_EQ(result_name(static_cast<VkResult>(-12345)), "VkResult -12345");
}

}  // namespace
}  // namespace lapwing::gpu
