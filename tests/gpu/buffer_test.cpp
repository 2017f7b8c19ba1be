#include "lapwing/gpu/buffer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/error_message.h"
#include "support/gpu.h"

namespace lapwing::gpu {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Buffer, TooLargeIsRefusedWithItsBytesAndTheLimit) {
  LAPWING_NEEDS_GPU();
  const Context context;
  constexpr VkDeviceSize kBytes = VkDeviceSize{1} << 52U;
  EXPECT_THAT(
      error_message<GpuError>([&] { const Buffer buffer(context, "response basis", kBytes); }),
      AllOf(HasSubstr("response basis"), HasSubstr(std::to_string(kBytes)), HasSubstr("allows"),
            HasSubstr("--device cpu")));
}

TEST(Buffer, MappedMemoryHasItsSize) {
  LAPWING_NEEDS_GPU();
  const Context context;
  for (const Memory memory : {Memory::upload, Memory::readback}) {
    const Buffer buffer(context, "numbers", 40, memory);
    EXPECT_EQ(buffer.mapped().size(), 40U);
    EXPECT_EQ(buffer.mapped_as<double>().size(), 5U);
  }
}

TEST(Buffer, EmptyBufferHasAHandleAndNoMemory) {
  LAPWING_NEEDS_GPU();
  const Context context;
  const Buffer buffer(context, "nothing", 0);
  EXPECT_NE(buffer.handle(), VkBuffer{VK_NULL_HANDLE});
  EXPECT_TRUE(buffer.mapped().empty());
}

TEST(Buffer, MovesItsMemoryAlong) {
  LAPWING_NEEDS_GPU();
  const Context context;
  Buffer a(context, "a", 4, Memory::upload);
  a.mapped_as<int>()[0] = 7;
  Buffer b(std::move(a));
  Buffer c(context, "c", 4, Memory::upload);
  c = std::move(b);
  EXPECT_EQ(c.mapped_as<int>()[0], 7);
  EXPECT_EQ(c.name(), "a");
}

TEST(Buffer, DeviceMemoryStaysUnmappedWhereAsked) {
  LAPWING_NEEDS_GPU();
  ContextOptions options;
  options.map_device_memory = false;
  const Context context(options);
  EXPECT_TRUE(Buffer(context, "a", 64).mapped().empty());
}

}  // namespace
}  // namespace lapwing::gpu
