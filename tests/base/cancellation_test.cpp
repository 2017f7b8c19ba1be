#include "lapwing/base/cancellation.h"

#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

const Progress kNo = [](std::string_view, double) { return false; };
const Progress kYes = [](std::string_view, double) { return true; };

// Loops until `check_cancelled` throws.
void work_without_end() {
  for (;;) check_cancelled();
}

TEST(Cancellation, ALoopWithoutAScopeGoesOn) {
  const AskAtEveryCheck asking;
  EXPECT_FALSE(can_be_cancelled());
  EXPECT_NO_THROW(check_cancelled());
}

TEST(Cancellation, ALoopInAScopeEndsWhenItsProgressSaysNo) {
  int asked = 0;
  const ProgressScope scope([&](std::string_view, double) { return ++asked < 3; });
  EXPECT_THROW(work_without_end(), Cancelled);
  EXPECT_EQ(asked, 3);
  EXPECT_THROW(check_cancelled(), Cancelled) << "and stays so";
}

TEST(Cancellation, AQuestionDoesNotGoBackBehindWhatAScopeInsideHasComeTo) {
  const AskAtEveryCheck asking;
  std::vector<double> heard;
  const Progress progress = [&](std::string_view, double fraction) {
    heard.push_back(fraction);
    return true;
  };
  const ProgressScope outer(progress);
  report_progress(progress, "stage", 0.25);
  {
    const ProgressScope inner(progress);
    report_progress(progress, "stage", 0.75);
  }
  check_cancelled();
  EXPECT_THAT(heard, ElementsAre(0.25, 0.75, 0.75));
}

TEST(Cancellation, TheInnermostScopeIsAskedAndAnEmptyOneIsNone) {
  const AskAtEveryCheck asking;
  const ProgressScope outer(kNo);
  {
    const ProgressScope inner(kYes);
    EXPECT_NO_THROW(check_cancelled());
  }
  const ProgressScope empty({});
  EXPECT_THROW(check_cancelled(), Cancelled);
}

TEST(Cancellation, ItIsAskedWithTheStageReportedLast) {
  const AskAtEveryCheck asking;
  std::vector<std::string> heard;
  const Progress hear = [&](std::string_view stage, double fraction) {
    heard.push_back(std::string(stage) + (fraction > 0.0 ? "+" : ""));
    return true;
  };
  const ProgressScope scope(hear);
  check_cancelled();
  report_progress(hear, "read", 0.5);
  check_cancelled();
  report_progress({}, "part of reading", 0.1);
  EXPECT_THAT(heard, ElementsAre("", "read+", "read+", "read+"));
}

TEST(Cancellation, WhatIsBeingWrittenIsFinished) {
  const AskAtEveryCheck asking;
  const ProgressScope scope(kNo);
  {
    const CancellationGuard whole;
    EXPECT_NO_THROW(check_cancelled());
  }
  EXPECT_THROW(check_cancelled(), Cancelled);
}

TEST(Cancellation, WhatTheCallbackThrowsComesThrough) {
  const ProgressScope scope(
      [](std::string_view, double) -> bool { throw std::runtime_error("from the callback"); });
  EXPECT_THROW(work_without_end(), std::runtime_error);
}

TEST(Cancellation, ACallbackMayItselfComeToACheck) {
  const AskAtEveryCheck asking;
  int asked = 0;
  const ProgressScope scope([&](std::string_view, double) {
    check_cancelled();
    return ++asked < 3;
  });
  EXPECT_THROW(work_without_end(), Cancelled);
}

TEST(Cancellation, ReachesTheThreadsOfAParallelLoop) {
  const std::thread::id here = std::this_thread::get_id();
  int asked = 0;
  bool only_here = true;
  const ProgressScope scope([&](std::string_view, double) {
    only_here = only_here && std::this_thread::get_id() == here;
    return ++asked < 3;
  });
  EXPECT_THROW(parallel_for(64, 1, [](std::size_t, std::size_t) { work_without_end(); }),
               Cancelled);
  EXPECT_TRUE(only_here);
}

TEST(Cancellation, ReachesWhatRunsAside) {
  int asked = 0;
  const ProgressScope scope([&](std::string_view, double) { return ++asked < 3; });
  EXPECT_THROW(parallel_invoke([] {}, work_without_end), Cancelled);
}

TEST(Cancellation, WhatRunsAsideEndsWhenTheOtherFails) {
  const ProgressScope scope(kYes);
  EXPECT_THROW(parallel_invoke([] { throw std::runtime_error("here"); }, work_without_end),
               std::runtime_error);
}

}  // namespace
}  // namespace lapwing
