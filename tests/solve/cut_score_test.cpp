#include "lapwing/solve/dissection/cut_score.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

using namespace dissection;

// By the definition: front after front.
double operations_of_halving(double separator, double border) {
  double sum = 0;
  double count = 1;
  for (int level = 0; level < 60; ++level, count *= 2) {
    sum += count * front_operations(separator, border);
    border = border / 2 + separator;
    separator /= std::numbers::sqrt2;
  }
  return sum;
}

TEST(CutScore, EstimatesTheSumOfAllFronts) {
  for (const double n : {100.0, 5'000.0}) {
    for (const double border : {0.0, 40.0, 300.0}) {
      const double expected = operations_of_halving(3.0 * std::sqrt(n), border);
      EXPECT_NEAR(patch_operations(n, border), expected, 1e-3 * expected);
    }
  }
  // Minus what is left without its first s pivots, by the definition of a dense factorization.
  double pivots = 0;
  for (int left = 2'000; left > 1'500; --left) pivots += double(left) * left;
  EXPECT_NEAR(front_operations(500, 1'500), pivots, 1e-3 * pivots);
}

TEST(CutScore, PrefersShortSeparatorsEqualSidesAndSharedBorders) {
  SideWeights even;
  even.add(500, 0, 0);
  even.add(500, 0, 1);
  SideWeights uneven = even;
  uneven.move(100, 0, 0);
  SideWeights lopsided = even;
  lopsided.move(300, 0, 0);
  EXPECT_LT(CutScore(even, 60), CutScore(even, 61));
  EXPECT_LT(CutScore(even, 60), CutScore(uneven, 60));
  EXPECT_LT(CutScore(uneven, 50), CutScore(even, 60));
  EXPECT_LT(CutScore(even, 200), CutScore(lopsided, 50)) << "a side is over its limit";
  SideWeights shared = even;
  shared.add(0, 40, 0);
  shared.add(0, 40, 1);
  SideWeights on_one = even;
  on_one.add(0, 80, 0);
  EXPECT_LT(CutScore(shared, 60), CutScore(on_one, 60));
  EXPECT_LT(CutScore(even, 60), CutScore(shared, 60));
  EXPECT_LT(CutScore(lopsided, 1'000), CutScore());
}

}  // namespace
}  // namespace lapwing
