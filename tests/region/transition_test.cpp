#include "lapwing/region/transition.h"

#include <gtest/gtest.h>

#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

TEST(Transition, GoesFromNothingToAllOverItsWidth) {
  for (const auto profile : {Transition::Profile::smooth, Transition::Profile::linear}) {
    const Transition transition{2.0, profile};
    EXPECT_EQ(fade(transition, 0.0), 0.0);
    EXPECT_EQ(fade(transition, 1.0), 0.5);
    EXPECT_EQ(fade(transition, 2.0), 1.0);
    EXPECT_EQ(fade(transition, kNoLimit), 1.0);
    for (double x = 0.0; x < 2.0; x += 0.1) {
      EXPECT_LT(fade(transition, x), fade(transition, x + 0.1));
    }
  }
}

TEST(Transition, SmoothHasNoKinkAndLinearIsStraight) {
  const Transition smooth{1.0, Transition::Profile::smooth};
  EXPECT_LT(fade(smooth, 0.01) / 0.01, 0.04);
  EXPECT_LT((1.0 - fade(smooth, 0.99)) / 0.01, 0.04);
  EXPECT_DOUBLE_EQ(fade({1.0, Transition::Profile::linear}, 0.3), 0.3);
}

TEST(Transition, WithoutAWidthIsAllThereEverywhere) {
  EXPECT_EQ(fade({}, 0.0), 1.0);
}

}  // namespace
}  // namespace lapwing
