#include "lapwing/gpu/profile.h"

#include <gtest/gtest.h>

#include "lapwing/gpu/command_list.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"
#include "lapwing/shaders/add_one.h"
#include "support/gpu.h"

namespace lapwing::gpu {
namespace {

constexpr std::uint32_t kProfiledCount = 1000;

ContextOptions profiled() {
  ContextOptions options;
  options.profile = true;
  return options;
}

// A command list of dispatches of add_one. Each dispatch reads the result of the previous one.
struct Adding {
  Adding(Context& context, int dispatches)
      : add_one(context, "add_one", shaders::add_one(), 4),
        a(context, "a", kProfiledCount * sizeof(std::uint32_t)),
        b(context, "b", kProfiledCount * sizeof(std::uint32_t)),
        list(context, "adding") {
    Recorder recorder(list);
    for (int d = 0; d < dispatches; ++d) {
      recorder.dispatch(add_one, kProfiledCount, {d % 2 == 0 ? a : b, d % 2 == 0 ? b : a},
                        kProfiledCount);
    }
    recorder.finish();
  }
  Kernel add_one;
  Buffer a;
  Buffer b;
  CommandList list;
};

TEST(Profile, CountsEverySubmissionAndEveryDispatchInIt) {
  LAPWING_NEEDS_GPU();
  Context context(profiled());
  Adding adding(context, 3);
  adding.list.run();
  adding.list.run();
  const DeviceUse use = context.profile()->take();
  EXPECT_EQ(use.submissions, 2U);
  ASSERT_TRUE(use.kernels.contains("add_one"));
  EXPECT_EQ(use.kernels.at("add_one").dispatches, 6U);
  EXPECT_EQ(context.profile()->take().submissions, 0U);
}

TEST(Profile, TimesADispatchWithinItsSubmission) {
  LAPWING_NEEDS_GPU();
  Context context(profiled());
  if (context.limits().timestampComputeAndGraphics == VK_FALSE) GTEST_SKIP() << "no timestamps";
  Adding adding(context, 2);
  adding.list.run();
  const DeviceUse use = context.profile()->take();
  const double kernel_ms = use.kernels.at("add_one").device_ms;
  EXPECT_GT(kernel_ms, 0.0);
  EXPECT_LE(kernel_ms, use.device_ms);
}

TEST(Profile, CountsADispatchThatItHasNoRoomToTime) {
  LAPWING_NEEDS_GPU();
  Context context(profiled());
  Adding adding(context, 100);
  adding.list.run();
  EXPECT_EQ(context.profile()->take().kernels.at("add_one").dispatches, 100U);
}

}  // namespace
}  // namespace lapwing::gpu
