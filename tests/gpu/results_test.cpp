#include "lapwing/gpu/results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/gpu/devices.h"
#include "support/error_message.h"

namespace lapwing::gpu {
namespace {

TEST(CheckResult, SuccessesPass) {
  EXPECT_NO_THROW(check_result(VK_SUCCESS, "vkCall", "a device"));
  EXPECT_NO_THROW(check_result(VK_SUBOPTIMAL_KHR, "vkCall", "a device"));
}

TEST(CheckResult, SaysWhatFailedWhere) {
  const auto fail = [] { check_result(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkCall", "a device"); };
  EXPECT_THAT(error_message<GpuError>(fail),
              ::testing::HasSubstr("vkCall failed on a device: VK_ERROR_OUT_OF_DEVICE_MEMORY"));
}

TEST(CheckResult, OnlyALostDeviceIsDeviceLost) {
  const auto check = [](VkResult result) { check_result(result, "vkCall", "a device"); };
  EXPECT_THROW(check(VK_ERROR_DEVICE_LOST), DeviceLost);
  try {
    check(VK_ERROR_INITIALIZATION_FAILED);
    ADD_FAILURE() << "accepted";
  } catch (const GpuError& error) {
    EXPECT_EQ(dynamic_cast<const DeviceLost*>(&error), nullptr);
  }
}

TEST(ResultName, IsTheNameOfTheSpecificationOrTheNumber) {
  EXPECT_EQ(result_name(VK_ERROR_OUT_OF_DATE_KHR), "VK_ERROR_OUT_OF_DATE_KHR");
  EXPECT_EQ(result_name(static_cast<VkResult>(-12345)), "VkResult -12345");
}

}  // namespace
}  // namespace lapwing::gpu
