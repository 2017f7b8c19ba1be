#include "lapwing/solve/dissection/shared_loops.h"

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

using namespace dissection;

TEST(SharedLoops, RunsEachRoundOnceOnAllThatHelp) {
  constexpr std::size_t kRounds = 400;
  SharedLoops loops;
  EXPECT_FALSE(loops.help());
  std::array<std::atomic<int>, kRounds> runs{};
  std::atomic<bool> ended = false;
  std::atomic<int> helped = 0;
  std::vector<std::jthread> helpers;
  for (int t = 0; t < 3; ++t) {
    helpers.emplace_back([&] {
      while (!ended) {
        if (loops.help()) ++helped;
        std::this_thread::yield();
      }
    });
  }
  while (helped == 0) {
    for (auto& count : runs) count = 0;
    loops.run(kRounds, [&](std::size_t k) {
      ++runs[k];
      std::this_thread::yield();
    });
    for (const auto& count : runs) ASSERT_EQ(count, 1);
  }
  ended = true;
}

TEST(SharedLoops, RethrowsAnErrorOnceNoRoundIsRunning) {
  SharedLoops loops;
  for (const std::size_t bad : {0U, 3U, 7U}) {
    std::vector<std::size_t> begun;
    EXPECT_THROW(loops.run(8,
                           [&](std::size_t k) {
                             begun.push_back(k);
                             if (k == bad) throw SolverError("bad round");
                           }),
                 SolverError);
    EXPECT_EQ(begun.size(), bad + 1);
    EXPECT_FALSE(loops.help());
  }
}

// Rounds that are begun elsewhere fail the loop, too, and the helper goes on.
TEST(SharedLoops, AnErrorOfAHelperIsTheLoops) {
  SharedLoops loops;
  std::atomic<bool> helping = false;
  std::jthread helper([&] {
    while (!helping) {
      loops.help();
      std::this_thread::yield();
    }
  });
  const auto owner = std::this_thread::get_id();
  EXPECT_THROW(loops.run(100'000,
                         [&](std::size_t) {
                           if (std::this_thread::get_id() == owner) {
                             for (int k = 0; k < 100 && !helping; ++k) std::this_thread::yield();
                             return;
                           }
                           helping = true;
                           throw SolverError("a helper's");
                         }),
               SolverError);
  helping = true;
}

}  // namespace
}  // namespace lapwing
