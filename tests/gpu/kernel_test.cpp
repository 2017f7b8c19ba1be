#include "lapwing/gpu/kernel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/shaders/add_one.h"
#include "lapwing/shaders/in_place.h"
#include "support/error_message.h"
#include "support/gpu.h"

namespace lapwing::gpu {
namespace {

using ::testing::HasSubstr;

TEST(Kernel, BufferThatIsNeitherReadonlyNorWriteonlyIsRefused) {
  LAPWING_NEEDS_GPU();
  const Context context;
  EXPECT_THAT(error_message<GpuError>([&] { Kernel(context, "in_place", shaders::in_place()); }),
              HasSubstr("in_place"));
}

TEST(Kernel, WorkgroupLargerThanTheDeviceAllowsIsRefused) {
  LAPWING_NEEDS_GPU();
  const Context context;
  EXPECT_THROW(Kernel(context, "add_one", shaders::add_one(), 4, 1U << 30U), GpuError);
}

TEST(Kernel, MorePushConstantsThanTheDeviceAllowsAreRefused) {
  LAPWING_NEEDS_GPU();
  const Context context;
  EXPECT_THROW(Kernel(context, "add_one", shaders::add_one(), 1U << 20U), GpuError);
}

class Dispatch : public ::testing::Test {
 protected:
  void SetUp() override { LAPWING_NEEDS_GPU(); }
};

TEST_F(Dispatch, RefusesWrongBuffersAndNamesTheKernel) {
  Context context;
  const Kernel kernel(context, "add_one", shaders::add_one(), sizeof(std::uint32_t));
  const Buffer a(context, "a", 64);
  const Buffer b(context, "b", 64);
  CommandList list(context, "test");
  Recorder recorder(list);
  const std::uint32_t count = 16;
  EXPECT_THAT(error_message<GpuError>([&] { recorder.dispatch(kernel, count, {a}, count); }),
              HasSubstr("add_one: it takes 2 buffers, not 1"));
  EXPECT_THAT(error_message<GpuError>([&] {
                recorder.dispatch(kernel, count, {a, b, b}, count);
              }),
              HasSubstr("it takes 2 buffers, not 3"));
  EXPECT_THAT(error_message<GpuError>([&] {
                recorder.dispatch(kernel, count, {a, b});
              }),
              HasSubstr("push constants"));
  EXPECT_THAT(error_message<GpuError>([&] {
                recorder.dispatch(kernel, count, {a, a}, count);
              }),
              HasSubstr("bound both for reading and for writing"));
}

TEST_F(Dispatch, RefusesARangeBeyondTheDevicesLimit) {
  Context context;
  const VkDeviceSize limit = context.limits().maxStorageBufferRange;
  constexpr VkDeviceSize kReasonable = VkDeviceSize{1} << 28U;
  if (limit > kReasonable) GTEST_SKIP() << "the limit is too large to exceed in a test";
  const Kernel kernel(context, "add_one", shaders::add_one(), sizeof(std::uint32_t));
  const Buffer a(context, "a", limit + 4);
  const Buffer b(context, "b", 64);
  CommandList list(context, "test");
  Recorder recorder(list);
  const std::uint32_t count = 16;
  EXPECT_THAT(error_message<GpuError>([&] {
                recorder.dispatch(kernel, count, {a, b}, count);
              }),
              HasSubstr("beyond the device's limit of " + std::to_string(limit)));
}

}  // namespace
}  // namespace lapwing::gpu
