#include "report/number_text.h"

#include <gtest/gtest.h>

namespace lapwing::bench {
namespace {

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

TEST(Padding, CountsCharactersNotBytes) {
  EXPECT_EQ(padded_left("±1", 4), "  ±1");
  EXPECT_EQ(padded_right("±1", 4), "±1  ");
  EXPECT_EQ(clipped("±1234567", 6), "±12...");
  EXPECT_EQ(clipped("123456", 6), "123456");
}

}  // namespace
}  // namespace lapwing::bench
