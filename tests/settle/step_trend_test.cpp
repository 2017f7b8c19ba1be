#include "lapwing/settle/step_trend.h"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

constexpr double kTolerance = 1e-4;

// After `steps` steps from 0.1 on, each `ratio` times as long as the one before.
StepTrend trend_of(double ratio, int steps = 5) {
  StepTrend trend;
  double step = 0.1;
  for (int k = 0; k < steps; ++k) {
    trend.add(step);
    step *= ratio;
  }
  return trend;
}

// The fifth step is 0.00625; 2^-6 of that is below the tolerance, 2^-5 above.
TEST(StepTrend, TellsHowManyHalvingsAreLeft) {
  const double left = trend_of(0.5).iterations_left(kTolerance).value();
  EXPECT_GT(left, 5.0);
  EXPECT_LT(left, 6.0);
  EXPECT_DOUBLE_EQ(left, std::log2(0.00625 / kTolerance));
}

TEST(StepTrend, HasNoneLeftBelowTheTolerance) {
  EXPECT_EQ(trend_of(0.01).iterations_left(kTolerance).value(), 0.0);
}

TEST(StepTrend, NeverEndsWhereStepsDoNotShorten) {
  for (const double ratio : {1.0, 1.5}) {
    EXPECT_TRUE(std::isinf(trend_of(ratio).iterations_left(kTolerance).value()));
  }
}

TEST(StepTrend, IsNotToldByFewerThanFourSteps) {
  EXPECT_FALSE(trend_of(0.1, 3).iterations_left(kTolerance).has_value());
  EXPECT_TRUE(trend_of(0.1, 4).iterations_left(kTolerance).has_value());
}

TEST(StepTrend, ForgetsTheStepsByAnotherHessian) {
  StepTrend trend = trend_of(0.5);
  trend.begin();
  EXPECT_FALSE(trend.iterations_left(kTolerance).has_value());
}

TEST(StepTrend, GoesByTheLastStepsAlone) {
  StepTrend trend = trend_of(0.5);
  for (int k = 0; k < 4; ++k) trend.add(0.01);
  EXPECT_TRUE(std::isinf(trend.iterations_left(kTolerance).value()));
}

}  // namespace
}  // namespace lapwing
