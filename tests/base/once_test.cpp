#include "lapwing/base/once.h"

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::test {
namespace {

TEST(Once, MakesInTheFirstCallAlone) {
  Once once;
  int made = 0;
  for (int call = 0; call < 3; ++call) once([&] { ++made; });
  EXPECT_EQ(made, 1);
}

TEST(Once, ACallThatThrowsHasMadeNothingAndTheNextTriesAgain) {
  Once once;
  int made = 0;
  for (int call = 0; call < 2; ++call) {
    EXPECT_THROW(once([] { throw std::runtime_error("no"); }), std::runtime_error);
  }
  once([&] { ++made; });
  once([&] { ++made; });
  EXPECT_EQ(made, 1);
}

TEST(Once, ManyThreadsSeeWhatOneHasMadeThoughTheFirstThrow) {
  constexpr int kThreads = 8;
  constexpr int kRounds = 200;
  for (int round = 0; round < kRounds; ++round) {
    Once once;
    std::atomic<int> tries = 0;
    int made = 0;  // guarded by `once` alone
    std::atomic<int> seen = 0;
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t) {
      threads.emplace_back([&] {
        try {
          once([&] {
            if (++tries <= 2) throw std::runtime_error("no");
            ++made;
          });
          seen += made;
        } catch (const std::runtime_error&) {
        }
      });
    }
    threads.clear();
    EXPECT_EQ(made, 1);
    EXPECT_EQ(seen, kThreads - 2);
  }
}

}  // namespace
}  // namespace lapwing::test
