#include "studies/real_report.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;

RealOutcome outcome(std::size_t flipped_triangles, double largest_edge, double detail_error) {
  RealOutcome made;
  made.measured = true;
  made.iterations = 12;
  made.flipped_triangles = flipped_triangles;
  made.largest_edge = largest_edge;
  made.detail_error = detail_error;
  made.edge_stretch = 0.25;
  made.prepare_ms = 3.5;
  made.solve_ms = 1.5;
  return made;
}

RealOutcome failed(const std::string& why) {
  RealOutcome made;
  made.failure = why;
  return made;
}

// Returns a run that meets all targets of the report.
RealRun good_run(const std::string& mesh) {
  return {mesh,
          "lift",
          2904,
          5804,
          7,
          "",
          outcome(0, 1.5, 0.02),
          outcome(0, 2.0, 0.1),
          outcome(0, 1.25, 0.03),
          outcome(0, 1.5, 0.02)};
}

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
  EXPECT_EQ(once.exceptions[0].name, "mesh 3.off lift");
  EXPECT_EQ(once.exceptions[0].why, "12 iterations");
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
  ASSERT_EQ(summary.failures.size(), 1u);
  EXPECT_EQ(summary.failures[0].why, "ours: no memory");
}

TEST(RealSummary, WhatArapCannotDoIsCountedAndNotCompared) {
  std::vector<RealRun> runs = good_runs(2);
  runs[0].arap = failed("not a manifold");
  runs[0].ours.largest_edge = 50.0;
  const RealSummary summary = summary_of(runs);
  EXPECT_EQ(summary.compared, 1u);
  EXPECT_EQ(summary.figures[kEdges].of, 1u);
  EXPECT_TRUE(summary.figures[kEdges].met());
  EXPECT_EQ(summary.failures.size(), 1u);
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
  ASSERT_EQ(summary.failures.size(), 1u);
  EXPECT_EQ(summary.failures[0].name, "dust.off lean");
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
  EXPECT_EQ(flips.exceptions[0].why, "5, ARAP 0");
}

TEST(RealSummary, TheLargestEdgeMayBe30PercentLongerThanAraps) {
  std::vector<RealRun> runs = good_runs(1);
  runs[0].arap.largest_edge = 2.0;
  runs[0].ours.largest_edge = 2.59;
  EXPECT_EQ(summary_of(runs).figures[kEdges].count, 1u);
  runs[0].ours.largest_edge = 2.61;
  const RealFigure edges = summary_of(runs).figures[kEdges];
  EXPECT_EQ(edges.count, 0u);
  EXPECT_EQ(edges.exceptions[0].why, "2.61, ARAP 2.00");
}

TEST(RealSummary, DetailErrorsWithinOneInAMillionAreTheSame) {
  std::vector<RealRun> runs = good_runs(1);
  runs[0].arap.detail_error = 0.02;
  runs[0].ours.detail_error = 0.02 + 0.9e-6;
  EXPECT_EQ(summary_of(runs).figures[kDetails].count, 1u);
  runs[0].ours.detail_error = 0.02 + 1.1e-6;
  EXPECT_EQ(summary_of(runs).figures[kDetails].count, 0u);
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
  EXPECT_THAT(summary.figures[kDraggedEdges].exceptions[0].name, HasSubstr("mesh 1.off"));
}

TEST(RealSummary, NoRunsMeetNothing) {
  for (const RealFigure& figure : summary_of({}).figures) {
    EXPECT_FALSE(figure.met());
  }
}

TEST(RealTable, PutsARunInOneLineBelowTheHeading) {
  const std::string heading = real_heading();
  const std::string line = line_of(good_run("cow.off"));
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  EXPECT_EQ(line.size(), heading.size() - heading.rfind('\n', heading.size() - 2) - 1);
  EXPECT_LE(line.size(), 101u);
}

TEST(RealTable, KeepsTheEndOfALongName) {
  const std::string line = line_of(good_run(std::string(100, 'x') + "/cow.off"));
  EXPECT_EQ(line.size(), line_of(good_run("cow.off")).size());
  EXPECT_THAT(line, HasSubstr("x/cow.off "));
}

TEST(RealTable, SaysAtTheEndWhatIsNotThere) {
  RealRun run = good_run("cow.off");
  run.smooth_arap.settled = false;
  EXPECT_THAT(line_of(run), HasSubstr(" *0 1.50"));
  run.arap = failed("not a manifold");
  EXPECT_THAT(line_of(run), HasSubstr("CGAL: not a manifold\n"));
  run.linear = failed("no memory");
  run.smooth_arap = failed("singular matrix");
  EXPECT_THAT(line_of(run), HasSubstr("linear: no memory; CGAL: not a manifold; Smooth ARAP: "
                                      "singular matrix\n"));
}

TEST(RealTable, NamesExceptionsBelowTheirFigure) {
  RealReport report;
  report.runs = {good_run("cow.off"), good_run("knot.off")};
  report.runs[1].ours.largest_edge = 7.0;
  const std::string text = text_of(report);
  EXPECT_THAT(text, HasSubstr("NOT met  largest edge within 1.3 times ARAP's: 1 of 2 (50%), at "
                              "least 95%\n      knot.off lift: 7.00, ARAP 1.25\n"));
  EXPECT_THAT(text, HasSubstr("met      settled: 2 of 2 (100%), at least 98%\n"));
}

TEST(RealTable, CountsTheEditsInWhichAMethodIsBetterThanLapwing) {
  RealReport report;
  report.runs = good_runs(4);
  report.runs[0].ours.constraint_error = 0.0025;
  report.runs[0].smooth_arap = outcome(1, 1.34, 0.0179);  // edges and details better by a tenth
  report.runs[1].smooth_arap = outcome(0, 1.36, 0.0181);
  report.runs[1].smooth_arap.settled = false;
  report.runs[2].smooth_arap = failed("singular matrix");
  report.runs[3].smooth_arap.detail_error = 0.03;
  const std::string text = text_of(report);
  EXPECT_THAT(text, HasSubstr("  Lapwing: 4 edits, 4 settled, 0 with flipped triangles, "
                              "constraints within 0.250%\n  ARAP: "));
  EXPECT_THAT(text,
              HasSubstr("  Smooth ARAP: 3 edits, 2 settled, 1 with flipped triangles, "
                        "constraints within 0%\n      better / worse than Lapwing by a tenth: "
                        "flips 0 / 1, largest edge 1 / 0, detail error 1 / 1\n"));
}

TEST(RealTable, CountsFilesThatArePassedOverForTheSameReason) {
  RealReport report;
  report.passed_over = {
      {"box.obj", "too small"}, {"dust.ply", "no triangles"}, {"u.off", "too small"}};
  const std::string text = text_of(report);
  EXPECT_THAT(text, HasSubstr("dust.ply: no triangles"));
  EXPECT_THAT(text, HasSubstr("2 files: too small"));
}

RealReport small_real_report() {
  RealReport report{"2023-05-06T07:08:09Z", "0123abcd", "Some Processor", 2, 61.5};
  report.runs = {good_run("cow.off"), good_run("knot.off")};
  report.runs[0].arap = failed("not a manifold");
  report.runs[1].ours.settled = false;
  report.runs[1].smooth_arap.constraint_error = 0.125;
  report.passed_over = {{"box.obj", "too small"}};
  return report;
}

TEST(RealJson, ReadsWhatItWrote) {
  const std::string json = to_json(small_real_report());
  EXPECT_EQ(to_json(parse_real_report(json, "report")), json);
}

TEST(RealJson, KeepsWhyAnOutcomeIsNotThere) {
  const RealReport report = parse_real_report(to_json(small_real_report()), "report");
  EXPECT_FALSE(report.runs[0].arap.measured);
  EXPECT_EQ(report.runs[0].arap.failure, "not a manifold");
  EXPECT_TRUE(report.runs[0].ours.measured);
  EXPECT_EQ(report.passed_over[0].why, "too small");
  EXPECT_EQ(report.runs[1].smooth_arap.constraint_error, 0.125);
}

TEST(RealJson, HoldsTheSummary) {
  EXPECT_THAT(to_json(small_real_report()), HasSubstr("\"run\":\"knot.off lift\""));
}

TEST(RealJson, RefusesOtherFormats) {
  EXPECT_THROW(parse_real_report(R"({"format": "lapwing-bench 1"})", "report"), InputError);
}

TEST(RealJson, PutsAMeshIntoOneLine) {
  RealMesh mesh;
  mesh.runs = {good_run("two\nlines.off")};
  const std::string line = to_json_line(mesh);
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  EXPECT_EQ(parse_real_mesh(line).runs.at(0).mesh, "two\nlines.off");
}

TEST(RealJson, SaysWhyAMeshWasPassedOver) {
  EXPECT_EQ(parse_real_mesh(to_json_line({"no triangles", {}})).passed_over, "no triangles");
}

}  // namespace
}  // namespace lapwing::bench
