#include "studies/real/real_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/made_up_runs.h"

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;

// In the order of the summary.
constexpr std::size_t kSettled = 0;
constexpr std::size_t kFlips = 1;
constexpr std::size_t kEdges = 2;
constexpr std::size_t kDetails = 3;
constexpr std::size_t kDraggedEdges = 4;
constexpr std::size_t kDraggedFlips = 5;

std::vector<RealRun> good_runs(std::size_t count) {
  std::vector<RealRun> runs;
  for (std::size_t i = 0; i < count; ++i) {
    runs.push_back(good_run("mesh " + std::to_string(i) + ".off"));
  }
  return runs;
}

TEST(RealSummary, MeetsEveryTargetWhenAllIsWell) {
  const RealSummary summary = summary_of(good_runs(4));
  EXPECT_EQ(summary.runs, 4u);
  EXPECT_EQ(summary.meshes, 4u);
  EXPECT_EQ(summary.compared, 4u);
  ASSERT_EQ(summary.figures.size(), 6u);
  for (const RealFigure& figure : summary.figures) {
    EXPECT_TRUE(figure.met()) << figure.name;
    EXPECT_TRUE(figure.exceptions.empty()) << figure.name;
  }
}

TEST(RealSummary, OneInFiftyNeedNotSettleAndIsNamed) {
  std::vector<RealRun> runs = good_runs(50);
  runs[3].ours.settled = false;
  const RealFigure once = summary_of(runs).figures[kSettled];
  EXPECT_EQ(once.count, 49u);
  EXPECT_TRUE(once.met());
  ASSERT_EQ(once.exceptions.size(), 1u);
  EXPECT_EQ(once.exceptions[0].run, "mesh 3.off lift");
  EXPECT_EQ(once.exceptions[0].values, "12 iterations");
  runs[4].ours.settled = false;
  EXPECT_FALSE(summary_of(runs).figures[kSettled].met());
}

TEST(RealSummary, WhatOursFailsToDoHasNotSettledAndIsNotCompared) {
  std::vector<RealRun> runs = good_runs(2);
  runs[0].ours = failed("no memory");
  const RealSummary summary = summary_of(runs);
  EXPECT_EQ(summary.figures[kSettled].count, 1u);
  EXPECT_EQ(summary.figures[kSettled].of, 2u);
  EXPECT_EQ(summary.figures[kEdges].of, 1u);
  EXPECT_EQ(summary.compared, 1u);
  ASSERT_EQ(summary.ours_failed.size(), 1u);
  EXPECT_EQ(summary.ours_failed[0].values, "no memory");
}

TEST(RealSummary, WhatArapCannotDoIsCountedAndNotCompared) {
  std::vector<RealRun> runs = good_runs(2);
  runs[0].arap = failed("not a manifold");
  runs[0].ours.largest_edge = 50.0;
  const RealSummary summary = summary_of(runs);
  EXPECT_EQ(summary.arap, 1u);
  EXPECT_EQ(summary.figures[kEdges].of, 1u);
  EXPECT_TRUE(summary.figures[kEdges].met());
  ASSERT_EQ(summary.arap_failed.size(), 1u);
}

TEST(RealSummary, RunsWithNothingToDeformAreNamedAndHeldAgainstNothing) {
  std::vector<RealRun> runs = good_runs(1);
  RealRun& nothing = runs.emplace_back();
  nothing.mesh = "dust.off";
  nothing.motion = "lean";
  nothing.failure = "no component is held by the belt";
  const RealSummary summary = summary_of(runs);
  EXPECT_EQ(summary.runs, 2u);
  EXPECT_EQ(summary.figures[kSettled].of, 1u);
  ASSERT_EQ(summary.not_run.size(), 1u);
  EXPECT_EQ(summary.not_run[0].run, "dust.off lean");
}

TEST(RealSummary, FlipsAreHeldAgainstAsManyRunsOfArap) {
  std::vector<RealRun> runs = good_runs(3);
  runs[0].ours.flipped_triangles = 5;
  EXPECT_FALSE(summary_of(runs).figures[kFlips].met());
  runs[1].arap.flipped_triangles = 1;
  const RealFigure flips = summary_of(runs).figures[kFlips];
  EXPECT_TRUE(flips.met());
  EXPECT_EQ(flips.count, 1u);
  ASSERT_EQ(flips.exceptions.size(), 1u);
  EXPECT_EQ(flips.exceptions[0].values, "5, ARAP 0");
}

TEST(RealSummary, TheLargestEdgeMayBe30PercentLongerThanAraps) {
  std::vector<RealRun> runs = good_runs(1);
  runs[0].arap.largest_edge = 2.0;
  runs[0].ours.largest_edge = 2.59;
  EXPECT_EQ(summary_of(runs).figures[kEdges].count, 1u);
  runs[0].ours.largest_edge = 2.61;
  const RealFigure edges = summary_of(runs).figures[kEdges];
  EXPECT_EQ(edges.count, 0u);
  EXPECT_EQ(edges.exceptions[0].values, "2.61, ARAP 2.00");
}

TEST(RealSummary, DetailErrorsWithinOneInAMillionAreTheSame) {
  std::vector<RealRun> runs = good_runs(1);
  runs[0].arap.detail_error = 0.02;
  runs[0].ours.detail_error = 0.02 + 0.9e-6;
  EXPECT_EQ(summary_of(runs).figures[kDetails].count, 1u);
  runs[0].ours.detail_error = 0.02 + 1.1e-6;
  EXPECT_EQ(summary_of(runs).figures[kDetails].count, 0u);
}

TEST(RealSummary, SaysWhereSmoothArapIsClearlyBetter) {
  std::vector<RealRun> runs = good_runs(2);
  EXPECT_TRUE(summary_of(runs).smooth_arap_better.empty());
  runs[1].ours.flipped_triangles = 2;
  runs[1].smooth_arap.detail_error = 0.0179;
  runs[1].smooth_arap.largest_edge = 1.36;
  const RealSummary summary = summary_of(runs);
  ASSERT_EQ(summary.smooth_arap_better.size(), 1u);
  EXPECT_EQ(summary.smooth_arap_better[0].values,
            "flips 2, Smooth ARAP 0; detail error 0.0200, Smooth ARAP 0.0179");
}

TEST(RealSummary, TheLinearResponseIsHeldToMeasuresOfItsOwn) {
  std::vector<RealRun> runs = good_runs(50);
  runs[0].linear.flipped_triangles = 3;
  EXPECT_TRUE(summary_of(runs).figures[kDraggedFlips].met());
  runs[1].linear.flipped_triangles = 1;
  runs[1].linear.largest_edge = 2.51;
  const RealSummary summary = summary_of(runs);
  EXPECT_FALSE(summary.figures[kDraggedFlips].met());
  EXPECT_FALSE(summary.figures[kDraggedEdges].met());
  EXPECT_THAT(summary.figures[kDraggedEdges].exceptions[0].run, HasSubstr("mesh 1.off"));
}

TEST(RealSummary, NoRunsMeetNothing) {
  for (const RealFigure& figure : summary_of({}).figures) {
    EXPECT_FALSE(figure.met());
    EXPECT_EQ(figure.share(), 0.0);
  }
}

}  // namespace
}  // namespace lapwing::bench
