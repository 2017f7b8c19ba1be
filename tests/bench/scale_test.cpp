#include "report/scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing::bench {
namespace {

using ::testing::DoubleNear;
using ::testing::Pointwise;

TEST(Scale, PutsTheEndsOfTheAxisWhereTheyAre) {
  const Scale linear = Scale::linear(2.0, 4.0, 100.0, 300.0);
  EXPECT_DOUBLE_EQ(linear(2.0), 100.0);
  EXPECT_DOUBLE_EQ(linear(3.0), 200.0);
  const Scale upwards = Scale::logarithmic(1.0, 100.0, 300.0, 100.0);
  EXPECT_DOUBLE_EQ(upwards(1.0), 300.0);
  EXPECT_DOUBLE_EQ(upwards(10.0), 200.0);
  EXPECT_DOUBLE_EQ(upwards(100.0), 100.0);
}

TEST(Scale, HasTicksAtRoundNumbers) {
  EXPECT_THAT(Scale::linear(0.0, 1.0, 0.0, 200.0).ticks(40.0),
              Pointwise(DoubleNear(1e-12), {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
  EXPECT_THAT(Scale::logarithmic(4'000.0, 60'000.0, 0.0, 200.0).ticks(20.0),
              Pointwise(DoubleNear(1e-6), {5e3, 1e4, 2e4, 5e4}));
}

TEST(Scale, LeavesTicksOutThatWouldStandTooClose) {
  EXPECT_THAT(Scale::logarithmic(1.0, 1000.0, 0.0, 90.0).ticks(20.0),
              Pointwise(DoubleNear(1e-9), {1.0, 10.0, 100.0, 1000.0}));
  EXPECT_THAT(Scale::logarithmic(1.0, 10'000.0, 0.0, 60.0).ticks(20.0),
              Pointwise(DoubleNear(1e-9), {1.0, 100.0, 10'000.0}));
}

}  // namespace
}  // namespace lapwing::bench
