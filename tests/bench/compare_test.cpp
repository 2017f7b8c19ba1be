#include "report/compare.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/made_up_report.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing::bench {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<double> noisy(double median, double noise, int runs, std::mt19937& random) {
  std::normal_distribution<double> distribution(median, noise * median);
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) times.push_back(distribution(random));
  return times;
}

// Rows "stage 0" and on, of 100 ms and 5% noise, but for the first ones, which take `slowdown`
// more.
Report noisy_report(int rows, int runs, std::mt19937& random, int slow_rows = 0,
                    double slowdown = 0.0) {
  std::vector<Measurement> measurements;
  for (int r = 0; r < rows; ++r) {
    const double ms = r < slow_rows ? 100.0 * (1.0 + slowdown) : 100.0;
    measurements.push_back(row("stage " + std::to_string(r), noisy(ms, 0.05, runs, random)));
  }
  return report_of(measurements);
}

Report with_count(const std::string& name, std::uint64_t count) {
  Measurement m = row("factor", {1.0});
  m.counts[name] = count;
  return report_of({m});
}

const std::vector<double> kBefore{100.0, 101.0, 102.0, 103.0, 104.0, 105.0, 106.0};
std::vector<double> times(const std::vector<double>& ms, double factor) {
  std::vector<double> product = ms;
  for (double& value : product) value *= factor;
  return product;
}

TEST(Compare, FindsNothingBetweenAReportAndItself) {
  const Comparison comparison = compare(small_report(), small_report());
  EXPECT_EQ(comparison.verdict, Verdict::same);
  EXPECT_THAT(comparison.changes, IsEmpty());
  EXPECT_THAT(comparison.missing, IsEmpty());
  EXPECT_EQ(comparison.same_counts, 3u);
  EXPECT_EQ(comparison.same_times, 4u) << "three by the wall and one by the device";
}

TEST(Compare, TakesNoiseForAChangeInAtMostOneReportOfTwenty) {
  std::mt19937 random(3);
  int alarms = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Report before = noisy_report(30, 7, random);
    const Report after = noisy_report(30, 7, random);
    if (compare(before, after).verdict != Verdict::same) ++alarms;
  }
  EXPECT_LE(alarms, 50);
}

TEST(Compare, FindsASlowdownOfAFifthUnderNoise) {
  std::mt19937 random(4);
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Report before = noisy_report(10, 7, random);
    const Report after = noisy_report(10, 7, random, 1, 0.2);
    const Comparison comparison = compare(before, after);
    const bool is_it = comparison.verdict == Verdict::worse && comparison.changes.size() == 1 &&
                       comparison.changes[0].row.stage == "stage 0";
    if (is_it) ++found;
  }
  EXPECT_GE(found, 90);
}

TEST(Compare, CallsWhatGotFasterBetter) {
  const Report before = report_of({row("factor", kBefore)});
  const Report after = report_of({row("factor", times(kBefore, 0.8))});
  const Comparison comparison = compare(before, after);
  EXPECT_EQ(comparison.verdict, Verdict::better);
  ASSERT_EQ(comparison.changes.size(), 1u);
  EXPECT_EQ(comparison.changes[0].what, "wall ms");
  EXPECT_THAT(text_of(comparison), HasSubstr("103 -> 82.4"));
}

TEST(Compare, CallsNothingChangedThatDiffersByLessThanATwentieth) {
  const std::vector<double> steady{100.0, 100.1, 100.2, 100.3, 100.4, 100.5, 100.6};
  const Report before = report_of({row("factor", steady)});
  EXPECT_EQ(compare(before, report_of({row("factor", times(steady, 1.04))})).verdict,
            Verdict::same);
  EXPECT_EQ(compare(before, report_of({row("factor", times(steady, 1.06))})).verdict,
            Verdict::worse);
}

TEST(Compare, CallsNothingChangedThatDiffersByLessThanTheQuartiles) {
  const std::vector<double> wide{80.0, 81.0, 82.0, 100.0, 118.0, 119.0, 120.0};
  const std::vector<double> above{121.0, 121.5, 122.0, 123.0, 124.0, 125.0, 126.0};
  EXPECT_EQ(compare(report_of({row("factor", wide)}), report_of({row("factor", above)})).verdict,
            Verdict::same);
}

TEST(Compare, SaysWhenThereAreTooFewRunsToSeeOneChange) {
  std::mt19937 random(5);
  const Report before = noisy_report(300, 7, random);
  EXPECT_THAT(compare(before, noisy_report(300, 7, random, 1, 0.5)).notes,
              ElementsAre(AllOf(HasSubstr("300 of 300 times"), HasSubstr("with 8 runs"))));
  EXPECT_THAT(compare(noisy_report(10, 7, random), noisy_report(10, 7, random)).notes, IsEmpty());
}

TEST(Compare, JudgesTheDevicesOwnTimeToo) {
  Measurement before = row("drag frame", kBefore);
  before.device_ms = kBefore;
  Measurement after = before;
  after.device_ms = times(kBefore, 1.5);
  const Comparison comparison = compare(report_of({before}), report_of({after}));
  ASSERT_EQ(comparison.changes.size(), 1u);
  EXPECT_EQ(comparison.changes[0].what, "device ms");
}

TEST(Compare, DoesNotBlameTheCodeForABusyMachine) {
  const Report before = report_of({row("factor", kBefore), row("order", kBefore)});
  Report after =
      report_of({row("factor", times(kBefore, 1.25)), row("order", times(kBefore, 2.0))});
  for (auto rate :
       {&Limits::copy_gb_per_s, &Limits::matmul_gflops_float32, &Limits::matmul_gflops_float64}) {
    after.limits[0].*rate /= 1.25;
  }
  const Comparison comparison = compare(before, after);
  EXPECT_THAT(comparison.notes, ElementsAre(HasSubstr("The limits of CPU changed")));
  ASSERT_EQ(comparison.changes.size(), 1u) << "what slowed down by more than the machine did";
  EXPECT_EQ(comparison.changes[0].row.stage, "order");
}

TEST(Compare, DoesNotPraiseTheCodeForAFasterMachine) {
  const Report before = report_of({row("factor", kBefore)});
  Report after = report_of({row("factor", times(kBefore, 0.7))});
  after.limits[0].matmul_gflops_float64 *= 1.5;  // copies are as fast as they were
  EXPECT_EQ(compare(before, after).verdict, Verdict::same);
  after.limits[0].matmul_gflops_float64 = before.limits[0].matmul_gflops_float64;
  EXPECT_EQ(compare(before, after).verdict, Verdict::better);
}

TEST(Compare, JudgesNoTimesBetweenTwoProcessorsButCountsAllTheSame) {
  Report before = report_of({row("factor", kBefore)});
  Report after = report_of({row("factor", times(kBefore, 3.0))});
  after.host.processor = "Another Processor";
  before.measurements[0].counts["flops"] = 10;
  after.measurements[0].counts["flops"] = 10;
  EXPECT_EQ(compare(before, after).verdict, Verdict::same);
  EXPECT_THAT(compare(before, after).notes, ElementsAre(HasSubstr("Times are not judged")));
  after.measurements[0].counts["flops"] = 11;
  EXPECT_EQ(compare(before, after).verdict, Verdict::worse);
}

TEST(Compare, JudgesCountsAloneWhenAskedTo) {
  const Report before = report_of({row("factor", kBefore)});
  const Report after = report_of({row("factor", times(kBefore, 3.0))});
  EXPECT_EQ(compare(before, after, {false, {}}).verdict, Verdict::same);
}

TEST(Compare, CallsACountThatRoseWorseAndOneThatFellBetter) {
  const Comparison rose = compare(with_count("allocations", 12), with_count("allocations", 13));
  EXPECT_EQ(rose.verdict, Verdict::worse);
  EXPECT_THAT(text_of(rose), AllOf(HasSubstr("allocations"), HasSubstr("12 -> 13"),
                                   HasSubstr("Verdict: worse (counts: 1 rose")));
  EXPECT_EQ(compare(with_count("allocations", 13), with_count("allocations", 12)).verdict,
            Verdict::better);
}

TEST(Compare, LetsACountVaryByItsTolerance) {
  const CompareOptions options{true, {{"nonzeros", 0.01}}};
  EXPECT_EQ(compare(with_count("nonzeros", 1000), with_count("nonzeros", 1010), options).verdict,
            Verdict::same);
  EXPECT_EQ(compare(with_count("nonzeros", 1000), with_count("nonzeros", 1011), options).verdict,
            Verdict::worse);
  EXPECT_EQ(compare(with_count("flops", 1000), with_count("flops", 1001), options).verdict,
            Verdict::worse);
}

TEST(Compare, FailsWhenWhatWasCountedIsGone) {
  EXPECT_EQ(compare(with_count("flops", 10), report_of({})).verdict, Verdict::worse);
  const Comparison renamed = compare(with_count("flops", 10), with_count("bytes", 10));
  EXPECT_EQ(renamed.verdict, Verdict::worse);
  EXPECT_THAT(text_of(renamed), HasSubstr("flops (worse)"));
}

TEST(Compare, ListsRowsOfOneReportOnlyWithoutJudgingThem) {
  const Comparison comparison =
      compare(report_of({row("old", kBefore)}), report_of({row("fresh", kBefore)}));
  EXPECT_EQ(comparison.verdict, Verdict::same);
  EXPECT_THAT(text_of(comparison), AllOf(HasSubstr("gone    old"), HasSubstr("new     fresh")));
}

TEST(Compare, TellsWhatChangedInATable) {
  Report before = report_of({row("drag frame", kBefore), row("factor", kBefore), row("old", {})});
  Report after = report_of({row("drag frame", times(kBefore, 2.0)), row("factor", kBefore)});
  before.measurements[1].counts = {{"allocations", 0}, {"flops", 123'456'789'012}};
  after.measurements[1].counts = {{"allocations", 3}, {"flops", 123'456'789'000}};
  EXPECT_EQ(text_of(compare(before, after)), R"(armadillo, 26,002 vertices, on CPU
  worse   factor                         allocations   0 -> 3
  slower  drag frame                     wall ms       103 -> 206                             +100%
  better  factor                         flops         123,456,789,012 -> 123,456,789,000
armadillo, 26,002 vertices, on CPU
  gone    old

Unchanged: 0 counts, 1 times.
Verdict: worse (counts: 1 rose, 0 gone, 1 fell; times: 1 slower, 0 faster)
)");
}

TEST(Compare, RefusesAReportThatMeasuresARowTwice) {
  const Report twice = report_of({row("factor", kBefore), row("factor", kBefore)});
  EXPECT_THAT(error_message<InputError>([&] { compare(twice, twice); }),
              AllOf(HasSubstr("\"factor\""), HasSubstr("twice")));
}

}  // namespace
}  // namespace lapwing::bench
