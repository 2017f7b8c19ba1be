#include "report/table.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/made_up_report.h"

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;

TEST(Table, OfASmallReport) {
  EXPECT_EQ(table_of(small_report()),
            R"(CPU (cpu): copies 10.0 GB/s, multiplies matrices at 100 GFLOP/s
Some GPU (discrete GPU): copies 400 GB/s, multiplies matrices at 500 GFLOP/s

armadillo, 26,002 vertices, on CPU
  ms                              median  spread     cpu  device peak MB limit  ratio
  factor                             102  +-1.0%     200       -     512   39%  0.252 of CHOLMOD
  factor, CHOLMOD                    404  +-0.5%       -       -       -     -

armadillo, 26,002 vertices, on Some GPU
  ms                              median  spread     cpu  device peak MB limit  ratio
  assemble                          4.10  +-1.2%   0.600    1.25       -   15%

median, spread: wall time of a run, and half the distance between its quartiles
cpu, device: processor time of all threads, and time by the clock of the device
peak MB: memory while it runs; limit: share of the peak rates of the device
ratio: time of Lapwing over that of the peer

Targets
  met      0.252, at most 0.500    factor / CHOLMOD, armadillo, CPU
  NOT met  31.0, at least 60.0     frames a second, armadillo, Some GPU

)");
}

TEST(Table, RatesThatWereNotMeasuredAreNotShownAsZero) {
  Report report = small_report();
  report.limits[0].matmul_gflops_float32 = 0.0;
  report.limits[0].matmul_gflops_float64 = 0.0;
  report.limits[1].matmul_gflops_float64 = 0.0;
  EXPECT_THAT(table_of(report),
              ::testing::StartsWith("CPU (cpu): copies 10.0 GB/s; products of matrices are not "
                                    "measured without a BLAS\nSome GPU (discrete GPU): copies 400 "
                                    "GB/s, multiplies matrices at 20,000 GFLOP/s in float32\n"));
}

TEST(Table, IsAtMost100ColumnsWideWhateverTheNames) {
  Report report = small_report();
  const std::string word(120, 'x');
  for (Measurement& m : report.measurements) {
    m.stage += word;
    m.mesh += word;
    m.device += word;
    if (m.by != "Lapwing") m.by += word;
    m.peak_bytes = 123'456'000'000;
    for (double& ms : m.wall_ms) ms *= 1e3;
  }
  for (Limits& limits : report.limits) limits.device += word;
  for (Target& target : report.targets) {
    target.name += word;
    target.on += word;
  }
  std::istringstream lines(table_of(report));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Screen, OfASmallReport) {
  Report report = small_report();
  report.measurements.push_back(row("first drag", {25.0}));
  report.measurements.push_back(row("first drag", {50.0}));
  report.measurements.back().device = "Some GPU";
  report.targets = {{"first drag / CGAL ARAP preparation", "armadillo, CPU", 0.3, false, 0.25},
                    {"first drag / CGAL ARAP preparation", "armadillo, Some GPU", 0.3, false, 0.5}};
  EXPECT_EQ(screen_of(report),
            R"(Medians in ms on armadillo, 26,002 vertices
CPU: Some Processor 3 GHz, 2 threads; device: Some GPU

stage                               CPU  ratio device  ratio  peer                           ms  met
factor                              102  0.252                CHOLMOD                       404
assemble                                         4.10
first drag                         25.0  0.250   50.0  0.500  CGAL ARAP preparation         100  NO

CPU, device: ms of Lapwing, median of the runs; ratio: that over the time of the peer
peer, ms: what the stage is compared with, and its time; met: whether the target of the ratio is met

1 of 2 targets are met; --all-columns lists them and all numbers.
)");
}

TEST(Screen, ShowsStagesOfOtherMeshesAtTheirLargestSize) {
  Report report = small_report();
  for (const std::size_t n : {40'000u, 10'000u}) {
    report.measurements.push_back(row("coat", {1e-3 * static_cast<double>(n)}));
    report.measurements.back().mesh = "hills";
    report.measurements.back().vertices = n;
  }
  EXPECT_THAT(screen_of(report), HasSubstr("coat, hills 40,000                 40.0\n"));
}

TEST(Screen, OfCountsSaysThatThereAreNoTimes) {
  EXPECT_EQ(screen_of(report_of({row("factor", {})})), "The report has no times.\n");
}

}  // namespace
}  // namespace lapwing::bench
