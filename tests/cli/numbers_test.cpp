// Numbers that cannot be computed with, and results that are not what was asked for.
#include <gmock/gmock.h>

#include "cli/command_line.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;

class Numbers : public CommandLine {
 protected:
  Outcome bend(const std::string& flags) const {
    return lapwing(
        "deform tube.obj --roi all --belt box:-1,-1,-1,1,1,0.3 --handle box:-1,-1,2.7,1,1,4 "
        "--rotate 1,0,0,20 --device cpu --save bent.obj " +
        flags);
  }
};

TEST_F(Numbers, MoveBeyondAllCoordinatesWritesNothing) {
  const Outcome outcome = bend("--translate=1e160,0,0");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, HasSubstr("handle 0 moves 1e+160"));
  EXPECT_FALSE(std::filesystem::exists(file("bent.obj")));
}

TEST_F(Numbers, WeightThatHoldsNothingIsAWrongArgument) {
  const Outcome outcome = bend("--constraint-weight 1e-20");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("a number from 0.000001 to 1000000000000"));
}

TEST_F(Numbers, HandleThatMissesItsPlaceIsSaidAndStrictlyAnError) {
  const Outcome outcome = bend("--constraint-weight 0.001");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("a handle misses its place by"));
  EXPECT_EQ(bend("--constraint-weight 0.001 --strict").exit_code, 4);
  EXPECT_EQ(bend("--strict").exit_code, 0);
}

TEST_F(Numbers, HandleThatMissesItsPlaceIsSaidInABatch) {
  EXPECT_EQ(bend("--constraint-weight 0.001 --recipe bend.json").exit_code, 0);
  write("jobs.jsonl", "{\"id\": \"a\"}\n");
  EXPECT_EQ(lapwing("batch jobs.jsonl --recipe bend.json -o results").exit_code, 0);
  EXPECT_THAT(read("results/results.jsonl"), HasSubstr("a handle misses its place by"));
}

TEST_F(Numbers, MeshOfNoFloatsSizeIsRefused) {
  Mesh huge = cylinder(12, 20, 0.5, 3.0);
  for (Eigen::Vector3d& p : huge.positions) p *= 1e100;
  write_mesh(huge, file("tube.obj"));
  const Outcome outcome =
      lapwing("deform tube.obj --handle 239 --translate=1e99,0,0 --device cpu --save bent.obj");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, HasSubstr("scale the mesh"));
}

}  // namespace
}  // namespace lapwing
