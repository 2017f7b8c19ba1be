#include "lapwing/base/worker_pool.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <sched.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "support/sanitizers.h"

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

// Helper threads spin for a tenth of a millisecond before they sleep.
TEST(WorkerPool, HelpersThatSleepAreWoken) {
  WorkerPool pool(3);
  for (int round = 0; round < 5; ++round) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::atomic<int> calls{0};
    pool.run([&](int) {
      ++calls;
      while (calls < 3) std::this_thread::yield();
    });
    EXPECT_EQ(calls, 3);
  }
}

// Some virtual machines would wake a helper thread on the CPU of the caller. The helper would then
// wait until the caller has finished.
TEST(WorkerPool, HelpersThatSleepAreWokenOnOtherProcessorsThanTheCallers) {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  if (CPU_COUNT(&allowed) < 2) GTEST_SKIP() << "one processor";
  WorkerPool pool(2);
  for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (!CPU_ISSET(processor, &allowed)) continue;
    cpu_set_t own;
    CPU_ZERO(&own);
    CPU_SET(processor, &own);
    ASSERT_EQ(sched_setaffinity(0, sizeof own, &own), 0);
    bool may_run_there = true;
    for (int round = 0; round < 2000 && may_run_there; ++round) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      std::atomic<bool> helped{false};
      pool.run([&](int thread) {
        if (thread != 0) {
          cpu_set_t of_helper;
          CPU_ZERO(&of_helper);
          sched_getaffinity(0, sizeof of_helper, &of_helper);
          may_run_there = CPU_ISSET(processor, &of_helper);
          helped = true;
        }
        while (!helped) std::this_thread::yield();
      });
    }
    EXPECT_FALSE(may_run_there) << "processor " << processor;
  }
  EXPECT_EQ(sched_setaffinity(0, sizeof allowed, &allowed), 0);
}

TEST(WorkerPool, WaitsForAHelperThatTakesLong) {
  WorkerPool pool(2);
  std::atomic<bool> begun{false};
  std::atomic<bool> done{false};
  pool.run([&](int thread) {
    if (thread == 0) {
      while (!begun) std::this_thread::yield();
      return;
    }
    begun = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    done = true;
  });
  EXPECT_TRUE(done);
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

// With Python's multiprocessing or os.fork(), a child process ends while its copy of the parent's
// pool still exists.
TEST(WorkerPool, ChildOfAForkWorksAloneAndEnds) {
#ifdef LAPWING_THREAD_SANITIZER
  GTEST_SKIP()
      << "ThreadSanitizer ends a child that starts threads after a fork of several threads.";
#endif
  auto pool = std::make_unique<WorkerPool>(3);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));  // until the helpers sleep
  const pid_t child = fork();
  ASSERT_NE(child, -1);
  if (child == 0) {
    alarm(30);  // kills a child that hangs
    int calls = 0;
    for (int round = 0; round < 3; ++round) pool->run([&](int thread) { calls += 1 + thread; });
    pool.reset();
    WorkerPool own(2);
    std::atomic<bool> helped{false};
    own.run([&](int thread) {
      if (thread != 0) helped = true;
      while (!helped) std::this_thread::yield();
    });
    _exit(calls == 3 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  // The parent's helpers still work.
  std::atomic<bool> helped{false};
  pool->run([&](int thread) {
    if (thread != 0) helped = true;
    while (!helped) std::this_thread::yield();
  });
}

}  // namespace
}  // namespace lapwing
