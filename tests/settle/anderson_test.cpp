#include "lapwing/settle/anderson.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing {
namespace {

using ::testing::Each;
using ::testing::Lt;

// x <- c + D x with slow, different rates; the fixed point is c / (1 - D).
std::vector<double> linear_step(const std::vector<double>& x, double c = 1.0) {
  std::vector<double> g(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double rate = 1.0 - 1.0 / static_cast<double>(2 + 3 * i);
    g[i] = c + rate * x[i];
  }
  return g;
}

double distance_from_fixed_point(const std::vector<double>& x, double c = 1.0) {
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    largest = std::max(largest, std::abs(x[i] - c * static_cast<double>(2 + 3 * i)));
  }
  return largest;
}

TEST(Anderson, SolvesALinearIterationInAsManyStepsAsUnknowns) {
  std::vector<double> x(4, 0.0);
  Anderson anderson(x.size(), 5);
  for (int step = 0; step < 7; ++step) anderson.advance(x, linear_step(x));
  EXPECT_LT(distance_from_fixed_point(x), 1e-6);
  std::vector<double> plain(4, 0.0);
  for (int step = 0; step < 7; ++step) plain = linear_step(plain);
  EXPECT_GT(distance_from_fixed_point(plain), 1.0);
}

TEST(Anderson, FirstStepAfterARestartIsThePlainOne) {
  std::vector<double> x(4, 0.0);
  Anderson anderson(x.size(), 3);
  for (int step = 0; step < 3; ++step) anderson.advance(x, linear_step(x));
  anderson.restart();
  const std::vector<double> g = linear_step(x);
  anderson.advance(x, g);
  EXPECT_EQ(x, g);
}

TEST(Anderson, CarryingOnSolvesAnotherConstantInFewerStepsThanARestart) {
  const auto steps_after = [](auto change) {
    std::vector<double> x(4, 0.0);
    Anderson anderson(x.size(), 5);
    for (int step = 0; step < 7; ++step) anderson.advance(x, linear_step(x));
    change(anderson);
    int steps = 0;
    for (; distance_from_fixed_point(x, 3.0) > 1e-5; ++steps) {
      anderson.advance(x, linear_step(x, 3.0));
    }
    return steps;
  };
  const int carried_on = steps_after([](Anderson& anderson) { anderson.carry_on(); });
  const int restarted = steps_after([](Anderson& anderson) { anderson.restart(); });
  EXPECT_LT(2 * carried_on, restarted + 1);
}

TEST(Anderson, StaysAtAFixedPoint) {
  std::vector<double> x(3, 2.0);
  Anderson anderson(x.size(), 3);
  const std::vector<double> fixed = x;
  for (int step = 0; step < 5; ++step) anderson.advance(x, fixed);
  EXPECT_EQ(x, fixed);
}

}  // namespace
}  // namespace lapwing
