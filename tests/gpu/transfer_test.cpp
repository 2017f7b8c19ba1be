#include "lapwing/gpu/transfer.h"

#include <numeric>

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/gpu.h"

namespace lapwing::gpu {
namespace {

// The parameter selects mapped memory or staged copies, which discrete GPUs need.
class Transfer : public ::testing::TestWithParam<bool> {
 protected:
  static ContextOptions options() {
    ContextOptions options;
    options.map_device_memory = GetParam();
    return options;
  }
};

TEST_P(Transfer, BringsBackWhatItTookThere) {
  LAPWING_NEEDS_GPU();
  Context context(options());
  gpu::Transfer transfer(context);
  // The last size takes several pieces of staging memory.
  for (const std::size_t count : {0U, 1U, 3U, 1000U, 4500001U}) {
    std::vector<std::uint32_t> sent(count);
    std::iota(sent.begin(), sent.end(), 5U);
    const Buffer buffer(context, "numbers", count * sizeof(std::uint32_t));
    transfer.upload(buffer, std::span<const std::uint32_t>(sent));
    std::vector<std::uint32_t> received(count);
    transfer.download(buffer, std::span(received));
    EXPECT_EQ(received, sent);
  }
}

TEST_P(Transfer, TouchesOnlyItsRange) {
  LAPWING_NEEDS_GPU();
  Context context(options());
  gpu::Transfer transfer(context);
  const Buffer buffer(context, "numbers", 4 * sizeof(int));
  transfer.upload(buffer, std::span<const int>(std::vector{1, 2, 3, 4}));
  transfer.upload(buffer, std::span<const int>(std::vector{20, 30}), sizeof(int));
  std::vector<int> tail(3);
  transfer.download(buffer, std::span(tail), sizeof(int));
  EXPECT_EQ(tail, (std::vector{20, 30, 4}));
}

TEST_P(Transfer, CountsWhatCrosses) {
  LAPWING_NEEDS_GPU();
  Context context(options());
  gpu::Transfer transfer(context);
  const Buffer buffer(context, "numbers", 4 * sizeof(int));
  std::vector<int> numbers(4, 7);
  transfer.upload(buffer, std::span<const int>(numbers));
  EXPECT_EQ(context.transfers().uploaded, 16U);
  EXPECT_EQ(context.transfers().downloaded, 0U);
  numbers.resize(2);
  transfer.download(buffer, std::span(numbers), sizeof(int));
  EXPECT_EQ(context.transfers().uploaded, 16U);
  EXPECT_EQ(context.transfers().downloaded, 8U);
}

TEST_P(Transfer, BeyondTheEndIsRefused) {
  LAPWING_NEEDS_GPU();
  Context context(options());
  gpu::Transfer transfer(context);
  const Buffer buffer(context, "numbers", 8);
  std::vector<int> two(2);
  EXPECT_THROW(transfer.upload(buffer, std::span<const int>(two), 4), GpuError);
  EXPECT_THROW(transfer.download(buffer, std::span(two), 12), GpuError);
}

INSTANTIATE_TEST_SUITE_P(Memory, Transfer, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "mapped" : "staged"; });

}  // namespace
}  // namespace lapwing::gpu
