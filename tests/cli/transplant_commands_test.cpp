// `lapwing transplant` as a user meets it.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "lapwing/recipe/recipe.h"
#include "session/transplant_runs.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class TransplantCommands : public CommandLine {
 protected:
  void SetUp() override {
    write_mesh(icosphere(3), file("ball.ply"));
    write_mesh(test::finger(24, 30, 0.3, 1.0), file("finger.ply"));
  }
};

const char* const kFinger =
    "transplant ball.ply --part finger.ply --target-region near:0,0,1,0.5 --device cpu ";

TEST_F(TransplantCommands, WritesMeshReportAndRecipeThatRunsToTheSameMesh) {
  const Outcome flags =
      lapwing(std::string(kFinger) + "--save a.ply --report a.json --recipe a.recipe.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(flags.output, AllOf(HasSubstr("loops of"), HasSubstr("seam turns by")));
  const auto report = nlohmann::json::parse(read("a.json"));
  EXPECT_EQ(report["steps"][0]["transplant"]["part_loop"], 24);
  const Outcome recipe = lapwing("run a.recipe.json --device cpu --save b.ply --quiet");
  ASSERT_EQ(recipe.exit_code, 0) << recipe.output;
  EXPECT_EQ(read("a.ply"), read("b.ply"));
}

TEST_F(TransplantCommands, EveryFlagIsInItsRecipe) {
  const Outcome outcome = lapwing(
      "transplant ball.ply --part-region near:0,0,-1,0.4 --loop 0 --translate=0,0,2 "
      "--rotate 1,0,0,180 --scale 0.5 --pivot 0,0,-1 --snap --target-region near:0,0,1,0.5 "
      "--transition 0.1 --profile linear --padding 0.05 --belt 0.04 --weights uniform "
      "--sampling one_ring --no-remesh --device cpu --save a.ply --recipe a.recipe.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto step = std::get<TransplantStep>(read_recipe(file("a.recipe.json")).steps.at(0));
  EXPECT_TRUE(step.part.empty());
  EXPECT_TRUE(step.part_region.has_value());
  EXPECT_EQ(step.loop, 0U);
  EXPECT_TRUE(step.snap);
  EXPECT_EQ(std::get<SimilarityMove>(std::get<Move>(step.place)).scale,
            Eigen::Vector3d::Constant(0.5));
  EXPECT_EQ(step.parameters.transition, (Transition{0.1, Transition::Profile::linear}));
  EXPECT_EQ(step.parameters.padding, 0.05);
  EXPECT_EQ(step.parameters.belt, 0.04);
  EXPECT_EQ(step.parameters.weights, LaplacianWeights::uniform);
  EXPECT_EQ(step.parameters.sampling, MappedSampling::one_ring);
  EXPECT_EQ(step.parameters.remesh, Remeshing::none);
}

TEST_F(TransplantCommands, FitsByItselfUnlessToldWhereTo) {
  const Outcome outcome = lapwing(std::string(kFinger) +
                                  "--fit-rotate 30 --fit-scale 0.8 --save a.ply "
                                  "--recipe a.recipe.json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto step = std::get<TransplantStep>(read_recipe(file("a.recipe.json")).steps.at(0));
  EXPECT_EQ(std::get<LoopFit>(step.place), (LoopFit{30.0, 0.8, false}));
  const Outcome two_sizes =
      lapwing(std::string(kFinger) + "--fit-scale 0.8 --keep-size --save b.ply");
  EXPECT_EQ(two_sizes.exit_code, 3);
  EXPECT_THAT(two_sizes.output, HasSubstr("\"keep_size\" and \"scale\" exclude each other"));
  const Outcome both = lapwing(std::string(kFinger) + "--fit-rotate 30 --snap --save a.ply");
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.output, HasSubstr("--snap"));
}

TEST_F(TransplantCommands, WithoutAPartIsAUsageErrorAndWithAClosedOneAMeshError) {
  const Outcome none = lapwing("transplant ball.ply --target-region near:0,0,1,0.5 --save a.ply");
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.output, HasSubstr("--part"));
  const Outcome closed =
      lapwing("transplant ball.ply --part ball.ply --target-region near:0,0,1,0.5 --save a.ply");
  EXPECT_EQ(closed.exit_code, 3);
  EXPECT_THAT(closed.output, HasSubstr("lapwing cut"));
}

}  // namespace
}  // namespace lapwing
