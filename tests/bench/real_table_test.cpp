#include "studies/real/real_table.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/made_up_runs.h"

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;

TEST(RealTable, PutsARunInOneLineBelowTheHeading) {
  const std::string heading = real_heading();
  EXPECT_EQ(std::count(heading.begin(), heading.end(), '\n'), 2);
  const std::string line = line_of(good_run("cow.off"));
  EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  EXPECT_EQ(line.size(), heading.size() - heading.find('\n') - 1);
}

TEST(RealTable, KeepsTheEndOfALongName) {
  const std::string line = line_of(good_run(std::string(100, 'x') + "/cow.off"));
  EXPECT_EQ(line.size(), line_of(good_run("cow.off")).size());
  EXPECT_THAT(line, HasSubstr("x/cow.off "));
}

TEST(RealTable, SaysAtTheEndWhatIsNotThere) {
  RealRun run = good_run("cow.off");
  run.ours.settled = false;
  EXPECT_THAT(line_of(run), HasSubstr(" 12* "));
  run.arap = failed("not a manifold");
  EXPECT_THAT(line_of(run), HasSubstr("CGAL: not a manifold\n"));
  run.smooth_arap = failed("no memory");
  EXPECT_THAT(line_of(run), HasSubstr("CGAL: not a manifold; Smooth ARAP: no memory\n"));
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

TEST(RealTable, CountsFilesThatArePassedOverForTheSameReason) {
  RealReport report;
  report.passed_over = {
      {"box.obj", "too small"}, {"dust.ply", "no triangles"}, {"u.off", "too small"}};
  const std::string text = text_of(report);
  EXPECT_THAT(text, HasSubstr("dust.ply: no triangles"));
  EXPECT_THAT(text, HasSubstr("2 files: too small"));
}

TEST(RealTable, InMarkdownHasEveryRun) {
  RealReport report;
  report.runs = {good_run("cow.off"), good_run("knot.off")};
  report.runs[1].arap = failed("not finite");
  const std::string text = markdown_of(report);
  EXPECT_THAT(text, HasSubstr("| cow.off | lift | 2,904 | 7 | 12 | 0 | 1.50 | 0.0200 | 0 | 2.00 | "
                              "0.1000 | 0 | 1.25 | 0.0300 | 0 | 1.50 | 0.0250 |  |\n"));
  EXPECT_THAT(text, HasSubstr("|  |  |  | 0 | 1.50 | 0.0250 | CGAL: not finite |\n"));
}

}  // namespace
}  // namespace lapwing::bench
