#include "report/page.h"

#include <cmath>
#include <iterator>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/made_up_report.h"
#include "report/plots.h"

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// "order" and "factor" of ours and "factor" of a peer's, at three sizes.
Report growing_report() {
  Report report = small_report();
  for (const std::size_t n : {10'000, 20'000, 40'000}) {
    const auto size = static_cast<double>(n);
    for (Measurement m : {row("order", {1e-3 * size}), row("drag frame", {1e-4 * size}),
                          row("factor", {1e-5 * std::pow(size, 1.5)}),
                          row_by("CHOLMOD", "factor", {0.01 * size})}) {
      m.mesh = "hills <&>";
      m.vertices = n;
      m.counts["flops"] = 1'000'000 * n / 1'000;
      report.measurements.push_back(m);
    }
  }
  return report;
}

// Every element that is opened is closed, in the order that nesting asks for.
void expect_well_formed(const std::string& text) {
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-zA-Z][a-zA-Z0-9]*)([^<>]*?)(/?)>");
  for (std::sregex_iterator it(text.begin(), text.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2];
    if ((*it)[4].length() > 0 || name == "meta") continue;
    if ((*it)[1].length() == 0) {
      open.push_back(name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << name;
    ASSERT_EQ(open.back(), name);
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
}

TEST(Page, IsWellFormedAndNeedsNothingElse) {
  const std::string page = page_of(growing_report());
  expect_well_formed(page);
  EXPECT_THAT(page, StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
  EXPECT_THAT(page, Not(HasSubstr("href=")));
  EXPECT_THAT(page, Not(HasSubstr("url(")));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
}

TEST(Page, SaysWhereItWasMadeAndWhichTargetsAreMet) {
  const std::string page = page_of(small_report());
  EXPECT_THAT(page, HasSubstr("0123abcd+"));
  EXPECT_THAT(page, HasSubstr("Some Processor 3 GHz, 2 threads"));
  EXPECT_THAT(page, HasSubstr("<td class=\"met\">met</td><td>factor / CHOLMOD</td>"));
  EXPECT_THAT(page, HasSubstr("<td class=\"missed\">NOT met</td><td>frames a second</td>"));
}

TEST(Page, NamesAMeshAsItIsCalled) {
  const std::string page = page_of(growing_report());
  EXPECT_THAT(page, HasSubstr("hills &lt;&amp;&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("hills <")));
}

TEST(Page, OfAnEmptyReportHasNoSections) {
  const std::string page = page_of(Report());
  expect_well_formed(page);
  EXPECT_THAT(page, Not(HasSubstr("<section>")));
}

TEST(ScalingPlot, LabelsALineWithItsGrowth) {
  const Report report = growing_report();
  const auto plot = scaling_plot(report, "CPU", Lines::preparation, 500);
  ASSERT_TRUE(plot);
  EXPECT_THAT(plot->element(""), HasSubstr(">order ~ n^1.00</text>"));
  EXPECT_THAT(plot->element(""), Not(HasSubstr("drag frame"))) << "which is no preparation";
  EXPECT_THAT(plot->element(""), Not(HasSubstr("CHOLMOD")));
}

TEST(ScalingPlot, JoinsTheSizesOfOneMesh) {
  const auto plot = scaling_plot(growing_report(), "CPU", Lines::preparation, 500);
  ASSERT_TRUE(plot);
  const std::string text = plot->element("");
  // "factor" has four markers and a line through three: the other is of another mesh.
  const std::regex marker("factor by Lapwing");
  EXPECT_EQ(std::distance(std::sregex_iterator(text.begin(), text.end(), marker), {}), 4);
  const std::regex line("<polyline class=\"line s7\" points=\"[^ ]+ [^ ]+ [^ ]+\"/>");
  EXPECT_TRUE(std::regex_search(text, line));
}

TEST(PeerPlots, HaveEveryoneWhoDidAStage) {
  const std::vector<Svg> plots = peer_plots(growing_report(), "CPU", 300);
  ASSERT_EQ(plots.size(), 1u);
  EXPECT_THAT(plots[0].element(""), HasSubstr(">factor</text>"));
  EXPECT_THAT(plots[0].element(""), HasSubstr(">Lapwing</text>"));
  EXPECT_THAT(plots[0].element(""), HasSubstr(">CHOLMOD</text>"));
  EXPECT_THAT(plots[0].element(""), HasSubstr("dashed"));
}

TEST(ScalingPlot, IsNotDrawnOfOneSize) {
  EXPECT_FALSE(scaling_plot(small_report(), "CPU", Lines::preparation, 500));
  EXPECT_FALSE(scaling_plot(small_report(), "Some GPU", Lines::preparation, 500));
}

TEST(StagesPlot, TakesFromTheProcessorWhatTheDeviceDoesNot) {
  const auto plot = stages_plot(small_report(), "Some GPU", 500);
  ASSERT_TRUE(plot);
  EXPECT_THAT(plot->element(""), HasSubstr("<title>assemble: 4.10 ms, 3.9%</title>"));
  EXPECT_THAT(plot->element(""), HasSubstr("<title>factor: 102 ms, 96%</title>"));
  EXPECT_THAT(plot->element(""), HasSubstr(">106 ms</text>"));
}

TEST(RatiosPlot, HasABarForTheLargestMesh) {
  const auto plot = ratios_plot(growing_report(), 500);
  ASSERT_TRUE(plot);
  EXPECT_THAT(plot->element(""), HasSubstr("factor / CHOLMOD: 0.200  hills &lt;&amp;&gt; 40k"));
  EXPECT_FALSE(ratios_plot(report_of({row("factor", {1.0})}), 500));
}

TEST(LimitsPlot, CutsOffWhatIsFarBeyondTheLimit) {
  Measurement m = row("in cache", {1.0});
  m.counts["bytes"] = 100'000'000;  // ten times the rate of copies
  const auto plot = limits_plot(report_of({m}), 500);
  ASSERT_TRUE(plot);
  EXPECT_THAT(plot->element(""), HasSubstr(">150%</text>"));
  EXPECT_THAT(plot->element(""), Not(HasSubstr(">200%</text>")));
  EXPECT_THAT(plot->element(""), HasSubstr("1000%  armadillo 26k</text>"));
}

TEST(LimitsPlot, ShowsTheHighestShareFirst) {
  const auto plot = limits_plot(growing_report(), 500);
  ASSERT_TRUE(plot);
  const std::string text = plot->element("");
  EXPECT_LT(text.find("<title>drag frame: 10%"), text.find("<title>factor, CHOLMOD:"));
  EXPECT_FALSE(limits_plot(report_of({row("factor", {1.0})}), 500));
}

TEST(PlotsSvg, StandsAlone) {
  const std::string svg = plots_svg(growing_report());
  expect_well_formed(svg);
  EXPECT_THAT(svg, StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_THAT(svg, HasSubstr("<style>"));
  EXPECT_THAT(svg, HasSubstr("What a user waits for"));
  EXPECT_THAT(svg, HasSubstr("What a preparation consists of"));
}

}  // namespace
}  // namespace lapwing::bench
