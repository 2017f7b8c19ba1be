#include "report/report.h"

#include <gtest/gtest.h>

#include "bench/made_up_report.h"
#include "report/number_text.h"

namespace lapwing::bench {
namespace {

TEST(SpreadOf, InterpolatesBetweenTheNumbersAroundAQuartile) {
  const Spread spread = spread_of({4.0, 1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(spread.median, 2.5);
  EXPECT_DOUBLE_EQ(spread.low, 1.75);
  EXPECT_DOUBLE_EQ(spread.high, 3.25);
}

TEST(SpreadOf, IsTheNumberItselfForOneAndZeroForNone) {
  EXPECT_EQ(spread_of({7.0}).low, 7.0);
  EXPECT_EQ(spread_of({7.0}).high, 7.0);
  EXPECT_EQ(spread_of({}).high, 0.0);
}

TEST(LimitsOf, AreThoseOfTheMeasurementsDevice) {
  const Report report = small_report();
  Measurement m = row("factor", {1.0});
  m.device = "Some GPU";
  ASSERT_NE(limits_of(report, m), nullptr);
  EXPECT_EQ(limits_of(report, m)->type, "discrete GPU");
  m.device = "a device that nobody measured";
  EXPECT_EQ(limits_of(report, m), nullptr);
}

TEST(ShareOfLimit, OfAKernelIsOfTheCopyRateByTheDevicesOwnClock) {
  // 250 MB in 1.25 ms are 200 GB/s; the device copies 400.
  const Report report = small_report();
  Measurement kernel = report.measurements[2];
  kernel.wall_ms.clear();
  EXPECT_DOUBLE_EQ(share_of_limit(report, kernel), 0.5);
}

TEST(ShareOfLimit, OfAStageIsByTheWallThoughTheDeviceHasAPartInIt) {
  // 250 MB in 4.1 ms, of 400 GB/s.
  const Report report = small_report();
  EXPECT_DOUBLE_EQ(share_of_limit(report, report.measurements[2]), 0.25 / 4.1e-3 / 400.0);
}

TEST(ShareOfLimit, IsOfFloat64Products) {
  // 4e9 operations in 102 ms, of 100e9 a second.
  const Report report = small_report();
  EXPECT_DOUBLE_EQ(share_of_limit(report, report.measurements[0]), 4.0 / 0.102 / 100.0);
}

TEST(ShareOfLimit, IsTheLargerOfTheTwo) {
  Measurement m = row("factor", {1000.0});
  m.counts = {{"flops", 10'000'000'000}, {"bytes", 3'000'000'000}};
  EXPECT_DOUBLE_EQ(share_of_limit(report_of({m}), m), 0.3);
  m.counts["flops"] = 40'000'000'000;
  EXPECT_DOUBLE_EQ(share_of_limit(report_of({m}), m), 0.4);
}

TEST(ShareOfLimit, IsZeroWhereNothingIsCountedOrKnown) {
  const Report report = small_report();
  EXPECT_EQ(share_of_limit(report, row("factor", {1.0})), 0.0);
  Measurement counted = report.measurements[0];
  counted.device = "a device that nobody measured";
  EXPECT_EQ(share_of_limit(report, counted), 0.0);
}

TEST(ShortNumber, HasThreeDigitsThatCount) {
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(0.001234), "0.00123");
  EXPECT_EQ(short_number(1.0), "1.00");
  EXPECT_EQ(short_number(12.345), "12.3");
  EXPECT_EQ(short_number(123.45), "123");
  EXPECT_EQ(short_number(1234567.8), "1,234,568");
}

TEST(ShortNumber, LosesADecimalWhenRoundingAddsADigit) {
  EXPECT_EQ(short_number(9.999), "10.0");
  EXPECT_EQ(short_number(99.96), "100");
  EXPECT_EQ(short_number(999.7), "1,000");
}

TEST(ShortNumber, StopsAtANanosecond) {
  EXPECT_EQ(short_number(0.00000149), "0.000001");
  EXPECT_EQ(short_number(0.0000000149), "0.000000");
}

TEST(Percent, KeepsADecimalWhereItCounts) {
  EXPECT_EQ(percent(0.123), "12%");
  EXPECT_EQ(percent(0.0312), "3.1%");
  EXPECT_EQ(percent(1.0), "100%");
}

TEST(Padding, KeepsTheWidth) {
  EXPECT_EQ(padded_left("12", 4), "  12");
  EXPECT_EQ(padded_right("12", 4), "12  ");
  EXPECT_EQ(clipped("12345678", 6), "123...");
  EXPECT_EQ(clipped("123456", 6), "123456");
}

}  // namespace
}  // namespace lapwing::bench
