#include "lapwing/base/parallel.h"

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

TEST(ParallelFor, VisitsEveryItemOnce) {
  for (const std::size_t count : {0, 1, 7, 64, 1000, 100'001}) {
    for (const std::size_t grain : {0, 1, 64, 1'000'000}) {
      std::vector<int> visits(count, 0);
      parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
        for (; begin < end; ++begin) ++visits[begin];
      });
      EXPECT_EQ(std::accumulate(visits.begin(), visits.end(), std::size_t{0}), count);
      EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int v) { return v == 1; }));
    }
  }
}

TEST(ParallelFor, RethrowsWhatABodyThrowsAndWorksAgain) {
  const auto run = [](std::size_t bad) {
    parallel_for(1000, 1, [&](std::size_t begin, std::size_t end) {
      if (begin <= bad && bad < end) throw std::runtime_error("item " + std::to_string(bad));
    });
  };
  for (const std::size_t bad : {0, 500, 999}) EXPECT_THROW(run(bad), std::runtime_error);
  EXPECT_NO_THROW(run(1000));
}

TEST(ParallelFor, MayBeNestedAndUsedFromSeveralThreads) {
  std::atomic<int> visits{0};
  const auto nested = [&] {
    parallel_for(50, 1, [&](std::size_t begin, std::size_t end) {
      for (; begin < end; ++begin) {
        parallel_for(20, 1, [&](std::size_t first, std::size_t last) {
          visits += static_cast<int>(last - first);
        });
      }
    });
  };
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) threads.emplace_back(nested);
  }
  EXPECT_EQ(visits, 4 * 50 * 20);
}

TEST(ParallelInvoke, RunsTheFirstHereAndBothOnce) {
  std::thread::id where;
  std::atomic<int> here{0};
  std::atomic<int> aside{0};
  for (int round = 0; round < 200; ++round) {
    parallel_invoke(
        [&] {
          where = std::this_thread::get_id();
          ++here;
        },
        [&] { ++aside; });
    EXPECT_EQ(where, std::this_thread::get_id());
  }
  EXPECT_EQ(here, 200);
  EXPECT_EQ(aside, 200);
}

TEST(ParallelInvoke, FinishesBothBeforeItRethrows) {
  bool finished = false;
  EXPECT_THROW(parallel_invoke([] { throw std::runtime_error("here"); }, [&] { finished = true; }),
               std::runtime_error);
  EXPECT_TRUE(finished);
  EXPECT_THROW(parallel_invoke([] {}, [] { throw std::logic_error("aside"); }), std::logic_error);
}

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
}  // namespace lapwing
