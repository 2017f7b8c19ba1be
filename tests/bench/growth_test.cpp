#include "report/growth.h"

#include <cmath>

#include <gtest/gtest.h>

#include "bench/made_up_report.h"

namespace lapwing::bench {
namespace {

// ms = factor * n^exponent, but for a share of `off` at every other size.
Report powers(double exponent, double factor, const std::vector<std::size_t>& sizes, double off) {
  std::vector<Measurement> rows;
  for (const std::size_t n : sizes) {
    const double sign = rows.size() % 2 == 0 ? 1.0 : -1.0;
    const double ms = factor * std::pow(static_cast<double>(n), exponent) * (1.0 + sign * off);
    rows.push_back(row("factor", {0.5 * ms, ms, 9.0 * ms}));
    rows.back().vertices = n;
  }
  return report_of(rows);
}

TEST(Growth, OfAnExactPowerIsThatPower) {
  const auto growths = growths_of(powers(1.5, 2e-5, {10'000, 20'000, 70'000, 300'000}, 0.0));
  ASSERT_EQ(growths.size(), 1u);
  EXPECT_EQ(growths[0].stage, "factor");
  EXPECT_NEAR(growths[0].exponent, 1.5, 1e-12);
  EXPECT_NEAR(growths[0].factor, 2e-5, 1e-15);
  EXPECT_NEAR(growths[0].standard_error, 0.0, 1e-12);
  EXPECT_EQ(growths[0].sizes, 4u);
}

TEST(Growth, OffThePowerHasAStandardErrorThatCoversIt) {
  const auto growths =
      growths_of(powers(1.0, 1e-3, {10'000, 20'000, 40'000, 80'000, 160'000}, 0.05));
  ASSERT_EQ(growths.size(), 1u);
  EXPECT_GT(growths[0].standard_error, 0.005);
  EXPECT_NEAR(growths[0].exponent, 1.0, 3.0 * growths[0].standard_error);
}

TEST(Growth, IsNotFittedToTwoSizesNorToSmallMeshes) {
  EXPECT_TRUE(growths_of(powers(1.0, 1.0, {10'000, 20'000}, 0.0)).empty());
  EXPECT_TRUE(growths_of(powers(1.0, 1.0, {10'000, 20'000, 20'000}, 0.0)).empty());
  EXPECT_TRUE(growths_of(powers(1.0, 1.0, {1'000, 10'000, 20'000}, 0.0)).empty());
}

TEST(Growth, IsOfTheDevicesTimeWhereNothingElseWasMeasured) {
  Report report = powers(1.0, 1.0, {10'000, 20'000, 40'000}, 0.0);
  for (Measurement& m : report.measurements) {
    m.device_ms = {1e-6 * static_cast<double>(m.vertices) * static_cast<double>(m.vertices)};
  }
  EXPECT_NEAR(growths_of(report).at(0).exponent, 1.0, 1e-12);
  for (Measurement& m : report.measurements) m.wall_ms.clear();
  EXPECT_NEAR(growths_of(report).at(0).exponent, 2.0, 1e-12);
}

TEST(Growth, IsOfEveryStageBySomebodyOnADeviceAlone) {
  Report report = powers(1.0, 1.0, {10'000, 20'000, 40'000}, 0.0);
  for (Measurement m : powers(1.8, 1.0, {10'000, 20'000, 40'000}, 0.0).measurements) {
    m.by = "CHOLMOD";
    report.measurements.push_back(m);
  }
  const auto growths = growths_of(report);
  ASSERT_EQ(growths.size(), 2u);
  EXPECT_NEAR(growths[0].exponent, 1.0, 1e-12);
  EXPECT_NEAR(growths[1].exponent, 1.8, 1e-12);
  EXPECT_EQ(in_words(growths[1]), "n^1.80 +-0.00");
}

}  // namespace
}  // namespace lapwing::bench
