#include "lapwing/base/worker_pool.h"

#include <gtest/gtest.h>

namespace lapwing {
namespace {

TEST(WorkerPool, CallsTheJobOnTheCallerAndAtMostOncePerThread) {
  WorkerPool pool(4);
  for (int round = 0; round < 500; ++round) {
    std::atomic<unsigned> seen{0};
    pool.run([&](int thread) {
      const unsigned bit = 1U << static_cast<unsigned>(thread);
      EXPECT_EQ(seen.fetch_or(bit) & bit, 0U);
    });
    EXPECT_NE(seen & 1U, 0U);
  }
}

TEST(WorkerPool, HelpersTakePart) {
  WorkerPool pool(2);
  std::atomic<bool> helped{false};
  pool.run([&](int thread) {
    if (thread != 0) helped = true;
    while (!helped) std::this_thread::yield();
  });
  EXPECT_TRUE(helped);
}

TEST(WorkerPool, JobWithinAJobRunsOnItsThreadAlone) {
  WorkerPool pool(3);
  std::atomic<int> calls{0};
  std::atomic<int> outer{0};
  pool.run([&](int) {
    ++outer;
    pool.run([&](int thread) {
      EXPECT_EQ(thread, 0);
      ++calls;
    });
  });
  EXPECT_EQ(calls, outer);
}

TEST(WorkerPool, OfOneThreadIsTheCaller) {
  WorkerPool pool(1);
  int calls = 0;
  pool.run([&](int thread) { calls += 1 + thread; });
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace lapwing
