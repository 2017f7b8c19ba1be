#include "lapwing/gpu/recorder.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/shaders/add_one.h"
#include "support/gpu.h"

namespace lapwing::gpu {
namespace {

constexpr std::uint32_t kCount = 1000;
constexpr VkDeviceSize kBytes = kCount * sizeof(std::uint32_t);

class RecorderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_GPU();
    context = std::make_unique<Context>();
    list = std::make_unique<CommandList>(*context, "test", 2);
    add_one = std::make_unique<Kernel>(*context, "add_one", shaders::add_one(), 4);
    buffers.emplace(std::array{buffer("a"), buffer("b"), buffer("c"), buffer("d")});
  }

  Buffer buffer(const char* name) const { return {*context, name, kBytes}; }

  void fill(const Buffer& target, std::uint32_t value) const {
    gpu::Transfer(*context).upload(target,
                                   std::span<const std::uint32_t>(std::vector(kCount, value)));
  }
  std::vector<std::uint32_t> values(const Buffer& source) const {
    std::vector<std::uint32_t> result(source.bytes() / sizeof(std::uint32_t));
    gpu::Transfer(*context).download(source, std::span(result));
    return result;
  }
  static std::vector<std::uint32_t> all(std::uint32_t value) { return std::vector(kCount, value); }

  std::unique_ptr<Context> context;
  std::unique_ptr<CommandList> list;
  std::unique_ptr<Kernel> add_one;
  std::optional<std::array<Buffer, 4>> buffers;
};

TEST_F(RecorderTest, PutsABarrierBetweenAWriteAndItsReader) {
  const auto& [a, b, c, d] = *buffers;
  fill(a, 5);
  Recorder recorder(*list);
  recorder.dispatch(*add_one, kCount, {a, b}, kCount);
  recorder.dispatch(*add_one, kCount, {b, c}, kCount);
  EXPECT_EQ(recorder.barrier_count(), 1U);
  recorder.finish();
  list->run();
  EXPECT_EQ(values(c), all(7));
}

TEST_F(RecorderTest, PutsABarrierBetweenAReadAndALaterWrite) {
  const auto& [a, b, c, d] = *buffers;
  fill(a, 5);
  fill(c, 50);
  Recorder recorder(*list);
  recorder.dispatch(*add_one, kCount, {a, b}, kCount);
  recorder.dispatch(*add_one, kCount, {c, a}, kCount);
  EXPECT_EQ(recorder.barrier_count(), 1U);
  recorder.finish();
  list->run();
  EXPECT_EQ(values(b), all(6));
  EXPECT_EQ(values(a), all(51));
}

TEST_F(RecorderTest, LeavesIndependentDispatchesAlone) {
  const auto& [a, b, c, d] = *buffers;
  fill(a, 5);
  Recorder recorder(*list);
  recorder.dispatch(*add_one, kCount, {a, b}, kCount);
  recorder.dispatch(*add_one, kCount, {a, c}, kCount);
  EXPECT_EQ(recorder.barrier_count(), 0U);
  recorder.dispatch(*add_one, kCount, {b, d}, kCount);
  EXPECT_EQ(recorder.barrier_count(), 1U);
}

TEST_F(RecorderTest, SecondReaderOfOneWriteNeedsNoSecondBarrier) {
  const auto& [a, b, c, d] = *buffers;
  fill(a, 5);
  Recorder recorder(*list);
  recorder.dispatch(*add_one, kCount, {a, b}, kCount);
  recorder.dispatch(*add_one, kCount, {b, c}, kCount);
  recorder.dispatch(*add_one, kCount, {b, d}, kCount);
  EXPECT_EQ(recorder.barrier_count(), 1U);
}

TEST_F(RecorderTest, OrdersFillsCopiesAndDispatches) {
  const auto& [a, b, c, d] = *buffers;
  Recorder recorder(*list);
  recorder.fill(a, 3);
  recorder.dispatch(*add_one, kCount, {a, b}, kCount);
  recorder.copy(b, c);
  recorder.dispatch(*add_one, kCount, {c, a}, kCount);
  EXPECT_EQ(recorder.barrier_count(), 3U);
  recorder.finish();
  list->run();
  EXPECT_EQ(values(a), all(5));
}

TEST_F(RecorderTest, LaterStageOfAReadWaitsForTheWriteToo) {
  const auto& [a, b, c, d] = *buffers;
  fill(a, 1);
  Recorder recorder(*list);
  recorder.dispatch(*add_one, kCount, {a, b}, kCount);
  recorder.copy(b, c);
  recorder.dispatch(*add_one, kCount, {b, d}, kCount);
  EXPECT_EQ(recorder.barrier_count(), 2U);
  recorder.finish();
  list->run();
  EXPECT_EQ(values(c), all(2));
  EXPECT_EQ(values(d), all(3));
}

TEST_F(RecorderTest, ListsSeeWhatEarlierListsWroteWithoutAWaitBetween) {
  const auto& [a, b, c, d] = *buffers;
  fill(a, 0);
  CommandList back(*context, "back");
  {
    Recorder recorder(*list);
    recorder.dispatch(*add_one, kCount, {a, b}, kCount);
    recorder.finish();
  }
  {
    Recorder recorder(back);
    recorder.dispatch(*add_one, kCount, {b, a}, kCount);
    recorder.finish();
  }
  std::uint64_t last = 0;
  for (int round = 0; round < 3; ++round) {
    EXPECT_GT(list->submit(), last);
    last = back.submit();
  }
  context->wait(last);
  EXPECT_EQ(values(a), all(6));
  EXPECT_GE(context->completed(), last);
}

TEST_F(RecorderTest, ResubmittedListReadsNewParameters) {
  const Buffer parameters(*context, "parameters", kBytes, Memory::upload);
  const Buffer result = buffer("result");
  Recorder recorder(*list);
  recorder.dispatch(*add_one, kCount, {parameters, result}, kCount);
  recorder.finish();
  for (const std::uint32_t value : {1U, 10U}) {
    std::ranges::fill(parameters.mapped_as<std::uint32_t>(), value);
    list->run();
    EXPECT_EQ(values(result), all(value + 1));
  }
}

TEST_F(RecorderTest, DispatchReachesInvocationsBeyondOneRowOfWorkgroups) {
  const std::uint32_t count = context->limits().maxComputeWorkGroupCount[0] + 5;
  if (count > (1U << 24U)) GTEST_SKIP() << "a row of workgroups is too long to exceed in a test";
  const Kernel singles(*context, "add_one", shaders::add_one(), 4, 1);
  const Buffer a(*context, "a", count * sizeof(std::uint32_t));
  const Buffer b(*context, "b", count * sizeof(std::uint32_t));
  Recorder recorder(*list);
  recorder.fill(a, 1);
  recorder.fill(b, 0);
  recorder.dispatch(singles, count, {a, b}, count);
  recorder.finish();
  list->run();
  EXPECT_EQ(values(b), std::vector(count, 2U));
}

TEST_F(RecorderTest, ListWithoutCommandsCannotBeSubmitted) {
  EXPECT_THROW(list->submit(), GpuError);
  { const Recorder dropped(*list); }
  EXPECT_THROW(list->submit(), GpuError);
}

TEST_F(RecorderTest, TimestampsRise) {
  const auto& [a, b, c, d] = *buffers;
  fill(a, 1);
  Recorder recorder(*list);
  const std::uint32_t before = recorder.timestamp();
  recorder.dispatch(*add_one, kCount, {a, b}, kCount);
  const std::uint32_t after = recorder.timestamp();
  recorder.finish();
  list->run();
  if (context->limits().timestampComputeAndGraphics == VK_FALSE) GTEST_SKIP() << "no timestamps";
  constexpr double kMinute = 60e3;  // an unsigned difference of decreasing times would be huge
  EXPECT_GT(list->milliseconds_between(before, after), 0.0);
  EXPECT_LT(list->milliseconds_between(before, after), kMinute);
}

}  // namespace
}  // namespace lapwing::gpu
