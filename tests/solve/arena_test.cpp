#include "lapwing/solve/block_cholesky/arena.h"

#include <utility>

#include <gtest/gtest.h>

#include "support/failing_new.h"

namespace lapwing::cholesky {
namespace {

constexpr std::size_t kMegabyte = (std::size_t{1} << 20) / sizeof(double);

// Returns the number of allocations when an arena reserves memory for `count` numbers.
long calls_to_reserve(std::size_t count) {
  const test::FailingNew counter(-1);
  Arena<double> arena;
  arena.reserve(count);
  return test::FailingNew::calls();
}

class SpareMemory : public ::testing::Test {
 protected:
  SpareMemory() { free_spare_memory(); }
  ~SpareMemory() override { free_spare_memory(); }
};

TEST_F(SpareMemory, IsUsedByTheNextArenaOfAboutTheSize) {
  EXPECT_EQ(calls_to_reserve(10 * kMegabyte), 1);
  EXPECT_EQ(calls_to_reserve(10 * kMegabyte), 0);
  EXPECT_EQ(calls_to_reserve(7 * kMegabyte), 0);
  EXPECT_EQ(calls_to_reserve(11 * kMegabyte), 1) << "too small";
  EXPECT_EQ(calls_to_reserve(3 * kMegabyte), 1) << "a waste";
}

TEST_F(SpareMemory, HasRoomForASomewhatLargerArena) {
  EXPECT_EQ(calls_to_reserve(33 * kMegabyte), 1);
  EXPECT_EQ(calls_to_reserve(38 * kMegabyte), 0);
  EXPECT_EQ(calls_to_reserve(42 * kMegabyte), 1) << "too small";
}

TEST_F(SpareMemory, IsAsLargeAsTheBlockItStandsIn) {
  EXPECT_EQ(calls_to_reserve(10 * kMegabyte), 1);
  Arena<double> arena;
  arena.reserve(6 * kMegabyte);
  EXPECT_EQ(arena.bytes(), arena_bytes<double>(10 * kMegabyte));
  const double* const before = arena.data();
  arena.reserve(9 * kMegabyte);
  EXPECT_EQ(arena.data(), before);
}

TEST_F(SpareMemory, ServesOneArenaAtATime) {
  EXPECT_EQ(calls_to_reserve(4 * kMegabyte), 1);
  Arena<double> first;
  first.reserve(4 * kMegabyte);
  Arena<double> second;
  second.reserve(4 * kMegabyte);
  EXPECT_NE(first.data(), second.data());
  first.data()[0] = 1.0;
  second.data()[0] = 2.0;
  EXPECT_EQ(first.data()[0], 1.0);
}

TEST_F(SpareMemory, IsBounded) {
  EXPECT_EQ(calls_to_reserve(kMostSpareBytes / sizeof(double) + kMegabyte), 1);
  EXPECT_EQ(calls_to_reserve(kMostSpareBytes / sizeof(double) + kMegabyte), 1) << "too large";
  EXPECT_EQ(calls_to_reserve(100 * kMegabyte), 1);
  EXPECT_EQ(calls_to_reserve(201 * kMegabyte), 1);  // the 100 have to go
  EXPECT_EQ(calls_to_reserve(100 * kMegabyte), 1);
}

TEST_F(SpareMemory, OfSmallArenasIsNotKept) {
  EXPECT_EQ(calls_to_reserve(1000), 1);
  EXPECT_EQ(calls_to_reserve(1000), 1);
}

}  // namespace
}  // namespace lapwing::cholesky
