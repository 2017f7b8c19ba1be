#include "lapwing/render/color_map.h"

#include <gtest/gtest.h>

namespace lapwing {
namespace {

constexpr int kSteps = 64;

float luminance(ColorMap map, int step) {
  const Eigen::Vector3f weights(0.2126F, 0.7152F, 0.0722F);
  return weights.dot(map_color(map, static_cast<float>(step) / kSteps));
}

TEST(ColorMap, EveryColorIsDisplayable) {
  for (const ColorMap map : {ColorMap::sequential, ColorMap::diverging}) {
    for (int step = 0; step <= kSteps; ++step) {
      const Eigen::Vector3f color = map_color(map, static_cast<float>(step) / kSteps);
      EXPECT_GE(color.minCoeff(), 0.0F) << step;
      EXPECT_LE(color.maxCoeff(), 1.0F) << step;
    }
  }
}

TEST(ColorMap, SequentialGetsLighterAllTheWay) {
  for (int step = 0; step < kSteps; ++step) {
    EXPECT_LT(luminance(ColorMap::sequential, step), luminance(ColorMap::sequential, step + 1));
  }
}

TEST(ColorMap, DivergingIsLightestInTheMiddleAndAsDarkAtBothEnds) {
  for (int step = 0; step < kSteps / 2; ++step) {
    EXPECT_LT(luminance(ColorMap::diverging, step), luminance(ColorMap::diverging, step + 1));
    EXPECT_NEAR(luminance(ColorMap::diverging, step), luminance(ColorMap::diverging, kSteps - step),
                0.05F);
  }
}

TEST(ColorMap, NumbersOutsideTheRangeHaveTheColorsOfItsEnds) {
  EXPECT_EQ(map_color(ColorMap::sequential, -1.0F), map_color(ColorMap::sequential, 0.0F));
  EXPECT_EQ(map_color(ColorMap::sequential, 2.0F), map_color(ColorMap::sequential, 1.0F));
}

}  // namespace
}  // namespace lapwing
