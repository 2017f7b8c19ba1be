#include "files/file_words.h"

#include <chrono>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing::viewer {
namespace {

TEST(FileWords, SizesHaveTwoDigitsAtLeastAboveAKilobyte) {
  EXPECT_EQ(size_in_words(0), "0 B");
  EXPECT_EQ(size_in_words(999), "999 B");
  EXPECT_EQ(size_in_words(1000), "1.0 KB");
  EXPECT_EQ(size_in_words(9940), "9.9 KB");
  EXPECT_EQ(size_in_words(9960), "10 KB");
  EXPECT_EQ(size_in_words(999499), "999 KB");
  EXPECT_EQ(size_in_words(999600), "1.0 MB");
  EXPECT_EQ(size_in_words(23456789), "23 MB");
}

TEST(FileWords, DatesAreSortable) {
  const auto now = std::filesystem::file_time_type::clock::now();
  const std::string words = date_in_words(now);
  EXPECT_EQ(words.size(), 16U);
  EXPECT_LT(date_in_words(now - std::chrono::hours(24 * 400)), words);
}

}  // namespace
}  // namespace lapwing::viewer
