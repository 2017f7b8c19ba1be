#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lapwing/run/run_report.h"

namespace lapwing {
namespace {

RunReport sample() {
  RunReport report;
  report.device = {"Test device", "software", "driver 1", true};
  report.mesh = "a.obj";
  report.vertices = 7;
  report.timings.add("read", 1.5);
  StepReport step;
  step.op = "deform";
  step.handles = {2, 3};
  step.free = 4;
  step.deform.emplace();
  step.deform->turn_degrees = 260.0;
  step.deform->winding_degrees = 259.5;
  step.deform->commits = 2;
  step.timings.add("factor", 2.25);
  step.timings.add("factor", 1.0);
  step.deform->certificate.handle_error = std::numeric_limits<double>::infinity();
  step.deform->certificate.largest_edge_stretch_vertices = {3, 8};
  report.steps.push_back(step);
  return report;
}

TEST(Report, JsonHoldsDeviceCountsTimingsAndCertificate) {
  const auto json = nlohmann::json::parse(to_json(sample()));
  EXPECT_EQ(json["device"]["name"], "Test device");
  EXPECT_EQ(json["device"]["type"], "software");
  EXPECT_EQ(json["mesh"]["vertices"], 7);
  EXPECT_EQ(json["timings_ms"]["read"], 1.5);
  const auto& step = json["steps"][0];
  EXPECT_EQ(step["handle"], 5);
  EXPECT_EQ(step["free"], 4);
  EXPECT_EQ(step["turn_degrees"], 260.0);
  EXPECT_EQ(step["winding_degrees"], 259.5);
  EXPECT_EQ(step["commits"], 2);
  EXPECT_EQ(step["timings_ms"]["factor"], 3.25) << "times of one stage add up";
  EXPECT_EQ(step["certificate"]["relative_residual"], 0.0);
  EXPECT_EQ(step["certificate"]["largest_edge_stretch_vertices"], (std::vector<int>{3, 8}));
}

TEST(Report, VerticesAreListedOnlyWhereTheyWereMeasured) {
  RunReport report = sample();
  EXPECT_FALSE(nlohmann::json::parse(to_json(report))["steps"][0].contains("vertices"));
  report.steps[0].vertices = {{4, 9}, {10.5, 20}, {0.25, 0.5}, {0.125, 1}};
  const auto json = nlohmann::json::parse(to_json(report))["steps"][0]["vertices"];
  EXPECT_EQ(json["vertices"], (std::vector<int>{4, 9}));
  EXPECT_EQ(json["rotation_degrees"], (std::vector<double>{10.5, 20}));
  EXPECT_EQ(json["detail_error"], (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(json["stretch"], (std::vector<double>{0.125, 1}));
}

TEST(Report, NumbersThatJsonCannotSayBecomeNull) {
  const auto json = nlohmann::json::parse(to_json(sample()));
  EXPECT_TRUE(json["steps"][0]["certificate"]["handle_error"].is_null());
  EXPECT_TRUE(json["steps"][0]["certificate"]["largest_scale_vertex"].is_null());
}

TEST(Report, StagesAreListedForTheTerminal) {
  const std::string text = format_stages(sample());
  EXPECT_NE(text.find("Test device"), std::string::npos);
  EXPECT_NE(text.find("factor"), std::string::npos);
  EXPECT_NE(text.find("3.25"), std::string::npos);
  EXPECT_NE(text.find("2 commits"), std::string::npos);
}

}  // namespace
}  // namespace lapwing
