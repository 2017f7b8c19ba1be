#include "lapwing/render/offscreen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "support/environment.h"
#include "support/error_message.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;

std::string message_for_size(gpu::Context& context, std::uint32_t width, std::uint32_t height) {
  return error_message<GpuError>([&] { const OffscreenTarget target(context, width, height); });
}

TEST(OffscreenTarget, RefusesSizesBeyondTheDeviceAndNamesTheLimit) {
  LAPWING_NEEDS_GPU();
  gpu::Context context;
  const std::uint32_t limit = context.limits().maxImageDimension2D;
  EXPECT_THAT(message_for_size(context, limit + 1, 16), HasSubstr(std::to_string(limit)));
  EXPECT_THAT(message_for_size(context, 16, limit + 1), HasSubstr(std::to_string(limit)));
  EXPECT_THAT(message_for_size(context, 0, 16), HasSubstr("0 x 16"));
}

TEST(OffscreenTarget, RefusesMorePixelsThanAllowed) {
  LAPWING_NEEDS_GPU();
  gpu::Context context;
  EXPECT_NO_THROW(OffscreenTarget(context, 64, 64));
  const test::Environment lower("LAPWING_MOST_PIXELS", "4000");
  EXPECT_THAT(error_message<InputError>([&] { OffscreenTarget(context, 64, 64); }),
              HasSubstr("the picture would have 4,096 pixels, more than the limit of 4,000; "
                        "choose a smaller size"));
}

TEST(OffscreenTarget, TakesTheSamplesThatTheDeviceHas) {
  LAPWING_NEEDS_GPU();
  gpu::Context context;
  EXPECT_EQ(OffscreenTarget(context, 8, 8, 1).format().samples, VK_SAMPLE_COUNT_1_BIT);
  // Every Vulkan device has 4.
  EXPECT_EQ(OffscreenTarget(context, 8, 8, 4).format().samples, VK_SAMPLE_COUNT_4_BIT);
  EXPECT_EQ(OffscreenTarget(context, 8, 8, 5).format().samples, VK_SAMPLE_COUNT_4_BIT);
}

TEST(OffscreenTarget, IsTransparentWhereNothingIsDrawn) {
  LAPWING_NEEDS_GPU();
  gpu::Context context;
  const Image image = OffscreenTarget(context, 5, 3).render([](VkCommandBuffer) {});
  EXPECT_EQ(image.width, 5U);
  EXPECT_EQ(image.height, 3U);
  EXPECT_THAT(image.rgba, ::testing::AllOf(::testing::SizeIs(60), ::testing::Each(0)));
}

}  // namespace
}  // namespace lapwing
