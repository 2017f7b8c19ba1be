#include "report/rank_test.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::bench {
namespace {

std::vector<double> normal_numbers(std::size_t count, double mean, std::mt19937& random) {
  std::normal_distribution<double> distribution(mean, 1.0);
  std::vector<double> numbers(count);
  for (double& number : numbers) number = distribution(random);
  return numbers;
}

TEST(RankTest, CountsEveryWayToDealTheRanks) {
  // Of the 20 ways to choose 3 of 6, one lies all below and one all above.
  EXPECT_DOUBLE_EQ(rank_test({1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}), 2.0 / 20.0);
  EXPECT_DOUBLE_EQ(rank_test({1.0, 2.0, 4.0}, {3.0, 5.0, 6.0}), 4.0 / 20.0);
  EXPECT_DOUBLE_EQ(smallest_rank_test(7, 7), 2.0 / 3432.0);
  EXPECT_DOUBLE_EQ(smallest_rank_test(2, 5), 2.0 / 21.0);
}

TEST(RankTest, IsSymmetric) {
  const std::vector<double> a{1.0, 4.0, 6.0, 6.5};
  const std::vector<double> b{2.0, 3.0, 7.0, 8.0, 9.0};
  EXPECT_DOUBLE_EQ(rank_test(a, b), rank_test(b, a));
}

TEST(RankTest, GivesEqualNumbersTheirMiddleRank) {
  // Ranks 1, 2.5, 2.5, 4: of the six pairs, {1, 2.5} twice and {2.5, 4} twice are as far off.
  EXPECT_DOUBLE_EQ(rank_test({1.0, 2.0}, {2.0, 3.0}), 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(rank_test({1.0, 1.0, 1.0}, {1.0, 1.0}), 1.0);
  EXPECT_DOUBLE_EQ(rank_test({1.0, 2.0}, {}), 1.0);
}

TEST(RankTest, ApproximationGoesOverFromTheExactOne) {
  std::mt19937 random(1);
  for (int k = 0; k < 20; ++k) {
    const auto a = normal_numbers(20, 0.0, random);
    auto b = normal_numbers(20, 0.6, random);
    const double exact = rank_test(a, b);
    b.push_back(0.3);  // one more, in the middle: the approximation, and hardly another answer
    EXPECT_NEAR(rank_test(a, b), exact, 0.03 + 0.15 * exact);
  }
}

TEST(RankTest, ApproximationKeepsItsWordWithTies) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> coarse(0, 3);
  int alarms = 0;
  for (int k = 0; k < 2000; ++k) {
    std::vector<double> a(30);
    std::vector<double> b(40);
    for (double& v : a) v = coarse(random);
    for (double& v : b) v = coarse(random);
    if (rank_test(a, b) < 0.05) ++alarms;
  }
  EXPECT_NEAR(alarms / 2000.0, 0.05, 0.015);
}

TEST(DiscoveryThreshold, TakesTheLargestThatStaysBelowItsShare) {
  // Bounds 0.0125, 0.025, 0.0375, 0.05: the third holds, whatever the second does.
  EXPECT_DOUBLE_EQ(discovery_threshold({0.9, 0.03, 0.001, 0.028}, 0.05), 0.03);
  EXPECT_LT(discovery_threshold({0.9, 0.04, 0.02, 0.5}, 0.05), 0.0);
  EXPECT_LT(discovery_threshold({}, 0.05), 0.0);
}

}  // namespace
}  // namespace lapwing::bench
