#include "studies/real/real_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/made_up_runs.h"
#include "lapwing/base/errors.h"

namespace lapwing::bench {
namespace {

using ::testing::HasSubstr;

RealReport small_real_report() {
  RealReport report{"2023-05-06T07:08:09Z", "0123abcd", "Some Processor", 2, 61.5};
  report.runs = {good_run("cow.off"), good_run("knot.off")};
  report.runs[0].arap = failed("not a manifold");
  report.runs[1].ours.settled = false;
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
  EXPECT_EQ(report.passed_over[0].reason, "too small");
}

TEST(RealJson, HoldsTheSummary) {
  EXPECT_THAT(to_json(small_real_report()), HasSubstr("\"run\": \"knot.off lift\""));
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
