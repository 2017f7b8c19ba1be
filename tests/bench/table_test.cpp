#include "report/table.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/made_up_report.h"
#include "report/number_text.h"

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

Targets
  armadillo, CPU
    met      factor / CHOLMOD                                            0.252, at most 0.500
  armadillo, Some GPU
    NOT met  frames a second                                              31.0, at least 60.0

)");
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
  for (std::string line; std::getline(lines, line);) EXPECT_LE(character_count(line), 100u) << line;
}

TEST(Table, NamesEveryPeerBesideTheStage) {
  Report report = small_report();
  report.measurements.push_back(row_by("Eigen", "factor", {1020.0}));
  const std::string table = table_of(report);
  EXPECT_THAT(table, HasSubstr("0.252 of CHOLMOD\n"));
  EXPECT_THAT(table, HasSubstr("0.100 of Eigen\n"));
}

TEST(Table, PutsTargetsOnOneThingTogether) {
  Report report = small_report();
  report.targets.push_back({"another", "armadillo, CPU", 1.0, false, 0.5});
  const std::string table = table_of(report);
  EXPECT_LT(table.find("another"), table.find("frames a second"));
}

TEST(Table, TellsGrowthWhereThereAreSizesEnough) {
  Report report = small_report();
  EXPECT_THAT(table_of(report), Not(HasSubstr("Growth")));
  for (const std::size_t n : {10'000, 20'000, 40'000}) {
    report.measurements.push_back(row("order", {1e-3 * static_cast<double>(n)}));
    report.measurements.back().vertices = n;
  }
  EXPECT_THAT(table_of(report), HasSubstr("n^1.00 +-0.00"));
}

}  // namespace
}  // namespace lapwing::bench
