#include "lapwing/settle/tangent_trend.h"

#include <gtest/gtest.h>

namespace lapwing {
namespace {

constexpr double kTolerance = 1e-4;

// After `steps` steps from 0.1 on, each `ratio` times as long as the one before.
TangentTrend trend_of(double turn_ms, double ratio, int steps = 5) {
  TangentTrend trend;
  trend.begin(turn_ms);
  double step = 0.1;
  for (int k = 0; k < steps; ++k) {
    trend.add(step);
    step *= ratio;
  }
  return trend;
}

// From the fifth step, 6.25e-3, six more halve it to the tolerance.
TEST(TangentTrend, TheNextIsDueWhereItTakesLessThanWhatIsLeft) {
  const double iteration_ms = 10.0;
  const double three_more_ms = 3 * iteration_ms;
  EXPECT_TRUE(trend_of(59.0 - three_more_ms, 0.5).is_next_due(kTolerance, iteration_ms));
  EXPECT_FALSE(trend_of(61.0 - three_more_ms, 0.5).is_next_due(kTolerance, iteration_ms));
}

TEST(TangentTrend, TheNextIsDueWhereStepsDoNotShorten) {
  for (const double ratio : {1.0, 1.5}) {
    EXPECT_TRUE(trend_of(1e6, ratio).is_next_due(kTolerance, 1.0));
  }
}

TEST(TangentTrend, IsNotToldByFewerThanFourSteps) {
  EXPECT_TRUE(trend_of(1e6, 0.1, 3).is_next_due(kTolerance, 1.0));
  EXPECT_FALSE(trend_of(1e6, 0.1, 4).is_next_due(kTolerance, 1.0));
}

TEST(TangentTrend, ForgetsTheStepsByTheLastTangent) {
  TangentTrend trend = trend_of(1e6, 0.5);
  EXPECT_FALSE(trend.is_next_due(kTolerance, 1.0));
  trend.begin(1e6);
  EXPECT_TRUE(trend.is_next_due(kTolerance, 1.0));
}

// Of the four last steps alone.
TEST(TangentTrend, GoesByTheLastSteps) {
  TangentTrend trend = trend_of(1e6, 0.5);
  for (int k = 0; k < 4; ++k) trend.add(0.01);
  EXPECT_TRUE(trend.is_next_due(kTolerance, 1.0));
}

}  // namespace
}  // namespace lapwing
