// Steps that take detail off.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "lapwing/coating/peel.h"
#include "lapwing/session/report.h"
#include "session/coat_runs.h"

namespace lapwing::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class RunPeel : public CoatRuns {
 protected:
  void SetUp() override { write(relief(20, 4.0, 0.01), "target.ply"); }

  static std::string step(const std::string& region) {
    return R"({"op": "peel", "region": )" + region + R"(, "detail_size": 0.5})";
  }
};

TEST_F(RunPeel, IsWhatPeelMakesBitForBit) {
  const Mesh mesh = read("target.ply");
  const Peeled peeled = peel(mesh, {{AllVertices{}}, 0.5});
  const auto result = run(step(kAll));
  EXPECT_EQ(result->mesh.positions, peeled.mesh.positions);
  EXPECT_NE(result->mesh.positions, mesh.positions);
  const StepReport& report = result->report.steps.at(0);
  EXPECT_EQ(report.op, "peel");
  EXPECT_EQ(report.free, peeled.moved.size());
  EXPECT_EQ(report.roi, mesh.vertex_count());
  EXPECT_EQ(report.peel->largest_coating, peeled.largest_coating);
  const auto json = nlohmann::json::parse(to_json(result->report));
  EXPECT_EQ(json["steps"][0]["peel"]["mean_coating"], peeled.mean_coating);
}

TEST_F(RunPeel, GoesOnFromTheStepBefore) {
  const Peeled once = peel(read("target.ply"), {{AllVertices{}}, 0.5});
  const Peeled twice = peel(once.mesh, {{AllVertices{}}, 0.5});
  EXPECT_EQ(run(step(kAll) + ", " + step(kAll))->mesh.positions, twice.mesh.positions);
}

TEST_F(RunPeel, WarnsWhereNothingCanComeOff) {
  const auto result = run(step(R"({"vertices": [5]})"));
  EXPECT_EQ(result->mesh.positions, read("target.ply").positions);
  EXPECT_THAT(result->report.warnings, ElementsAre(HasSubstr("no detail was removed")));
}

}  // namespace
}  // namespace lapwing::test
