#include "lapwing/base/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/environment.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using test::Environment;
using ::testing::HasSubstr;

constexpr Limit kFew{"LAPWING_MOST_TESTS", "tests", 1000};

TEST(Limits, WhatIsBeyondIsRefusedWithBothNumbersAndTheWayOut) {
  EXPECT_NO_THROW(require_at_most(kFew, 1000, "this makes", "make fewer"));
  EXPECT_EQ(error_message<InputError>(
                [] { require_at_most(kFew, 1'234'567, "this makes", "make fewer"); }),
            "this makes 1,234,567 tests, more than the limit of 1,000; make fewer, or set "
            "LAPWING_MOST_TESTS to a larger number");
}

TEST(Limits, AVariableOfTheEnvironmentRaisesOne) {
  const Environment raised("LAPWING_MOST_TESTS", "2e6");
  EXPECT_EQ(limit_value(kFew), 2e6);
  EXPECT_NO_THROW(require_at_most(kFew, 1'234'567, "this makes", "make fewer"));
}

TEST(Limits, AVariableThatIsNoNumberIsNamed) {
  for (const char* text : {"many", "-1", "0", "10x", "nan"}) {
    const Environment set("LAPWING_MOST_TESTS", text);
    EXPECT_THAT(error_message<InputError>([] { limit_value(kFew); }),
                HasSubstr("LAPWING_MOST_TESTS is set to \"" + std::string(text) + "\""));
  }
}

TEST(Limits, MemoryIsRefusedBeforeItIsTaken) {
  const Environment set(kMemoryVariable, "5000000");
  EXPECT_EQ(allowed_memory(), 5'000'000U);
  EXPECT_EQ(allowed_memory(123), 123U);
  EXPECT_NO_THROW(require_memory(5'000'000, "it", "wait"));
  EXPECT_EQ(error_message<SolverError>([] { require_memory(9'500'000, "it", "wait"); }),
            "it needs 10 MB of memory, more than the limit of 6 MB; wait, or set "
            "LAPWING_MOST_MEMORY to more bytes");
}

TEST(Limits, MemoryThatMayBeTakenIsLessThanThereIs) {
  EXPECT_GT(allowed_memory(), 0U);
  const Environment none(kMemoryVariable, "");
  EXPECT_GT(allowed_memory(), 0U);
}

}  // namespace
}  // namespace lapwing
