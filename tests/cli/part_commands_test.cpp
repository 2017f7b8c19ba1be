// Tests `lapwing cut`, `lapwing parts` and `lapwing transplant`.
#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "io/rich_mesh.h"
#include "lapwing/recipe/recipe.h"
#include "run/transplant_runs.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class PartCommands : public CommandLine {
 protected:
  void SetUp() override { write_mesh(icosphere(3), file("ball.obj")); }
};

const std::string kCutCap = "cut ball.obj --region box:-1,-1,0.5,1,1,1 -o cap.obj ";

TEST_F(PartCommands, CutWritesPartAndRestWithTheirLoops) {
  EXPECT_THAT(succeed(kCutCap + "--rest rest.ply"),
              AllOf(HasSubstr("cap.obj: "), HasSubstr("rest.ply: "), HasSubstr("  loop 0: "),
                    Not(HasSubstr("loop 1"))));
  EXPECT_EQ(read_mesh(file("cap.obj")).face_count() + read_mesh(file("rest.ply")).face_count(),
            icosphere(3).face_count());
  const std::string quiet = succeed(kCutCap + "--quiet");
  EXPECT_EQ(quiet, "");
}

TEST_F(PartCommands, CutKeepsWhatTheMeshCarries) {
  write_mesh(rich_mesh(), file("rich.ply"));
  succeed("cut rich.ply --region 0,1,5,6 -o corner.ply");
  const Mesh rich = read_mesh(file("rich.ply"));
  const Mesh corner = read_mesh(file("corner.ply"));
  ASSERT_EQ(corner.vertex_count(), 4U);
  EXPECT_EQ(corner.attributes().vertex_colors.at(2), rich.attributes().vertex_colors.at(5));
  EXPECT_EQ(corner.attributes().vertex_extras.at(0).values.at(3), 600000);
  EXPECT_EQ(corner.attributes().comments, rich.attributes().comments);
}

TEST_F(PartCommands, CutSaysWhatIsOddAboutAPart) {
  const std::string two = R"('{"union": [{"box": {"min": [-1,-1,0.8], "max": [1,1,1]}},
                                         {"box": {"min": [-1,-1,-1], "max": [1,1,-0.8]}}]}')";
  EXPECT_THAT(succeed("cut ball.obj -o caps.obj --rest belt.obj --region " + two),
              AllOf(HasSubstr("caps.obj is in 2 pieces"),
                    HasSubstr("belt.obj has several boundary loops")));
}

TEST_F(PartCommands, CutThatLeavesNothingWritesNothing) {
  expect_refused("cut ball.obj --region all -o part.obj --rest rest.obj", 3,
                 {"--region", "nothing remains"});
  EXPECT_EQ(lapwing("cut ball.obj -o part.obj").exit_code, 2) << "without a region";
}

TEST_F(PartCommands, PartsAreAddedListedAndShown) {
  succeed(kCutCap);
  const std::string added = succeed("parts add shelf cap.obj --name dome --no-pictures");
  EXPECT_THAT(added, StartsWith("dome: "));
  const std::string listed = succeed("parts list shelf --no-pictures");
  EXPECT_EQ(listed, added);
  EXPECT_THAT(succeed("parts show shelf dome"),
              AllOf(HasSubstr("dome.obj"), HasSubstr("loop 0: ")));
}

TEST_F(PartCommands, BrokenFileIsNamedAndTheOthersAreListed) {
  std::filesystem::create_directory(file("shelf"));
  write_mesh(cylinder(12, 20, 0.5, 3.0), file("shelf/tube.obj"));
  write_mesh(icosphere(1), file("shelf/ball.obj"));
  write("shelf/broken.obj", "v 1 2\n");
  write("shelf/notes.txt", "no mesh");
  EXPECT_THAT(succeed("parts list shelf --no-pictures"),
              AllOf(HasSubstr("skipped shelf/broken.obj"), HasSubstr("skipped shelf/ball.obj"),
                    HasSubstr("tube: 240 vertices"), Not(HasSubstr("notes.txt"))));
}

TEST_F(PartCommands, WhatIsNoPartIsRefused) {
  expect_refused("parts add shelf ball.obj", 3, {"lapwing cut"});
  expect_refused("parts list nowhere", 6);
  expect_refused("parts", 2);
}

TEST_F(PartCommands, PicturesAreDrawnWhenTheyAreNeeded) {
  LAPWING_NEEDS_GPU();
  succeed(kCutCap);
  succeed("parts add shelf cap.obj");
  EXPECT_THAT(read("shelf/cap.png"), StartsWith("\x89PNG"));
  write("shelf/cap.png", "kept while it is new");
  succeed("parts list shelf");
  EXPECT_EQ(read("shelf/cap.png"), "kept while it is new");
  std::filesystem::remove(file("shelf/cap.png"));
  succeed("parts list shelf");
  EXPECT_THAT(read("shelf/cap.png"), StartsWith("\x89PNG"));
  succeed("parts show shelf cap -o large.png --size 64");
  EXPECT_THAT(read("large.png"), StartsWith("\x89PNG"));
}

TEST_F(PartCommands, WithoutADevicePartsStayWithoutPictures) {
  succeed(kCutCap);
  EXPECT_THAT(succeed("parts add shelf cap.obj --device no-such-device"),
              HasSubstr("note: parts stay without pictures"));
  EXPECT_FALSE(std::filesystem::exists(file("shelf/cap.png")));
  EXPECT_THAT(lapwing("parts list shelf --device no-such-device").output, HasSubstr("cap: "));
}

class TransplantCommands : public CommandLine {
 protected:
  void SetUp() override {
    write_mesh(icosphere(3), file("ball.ply"));
    write_mesh(test::finger(24, 30, 0.3, 1.0), file("finger.ply"));
  }
};

const std::string kFinger =
    "transplant ball.ply --part finger.ply --target-region near:0,0,1,0.5 --device cpu ";

TEST_F(TransplantCommands, WritesMeshReportAndRecipeThatRunsToTheSameMesh) {
  EXPECT_THAT(succeed(kFinger + "--save a.ply --report a.json --recipe a.recipe.json"),
              AllOf(HasSubstr("loops of"), HasSubstr("seam turns by")));
  const auto report = nlohmann::json::parse(read("a.json"));
  EXPECT_EQ(report["steps"][0]["transplant"]["part_loop"], 24);
  expect_recipe_repeats("a.recipe.json", "a.ply");
}

TEST_F(TransplantCommands, EveryFlagIsInItsRecipe) {
  succeed(
      "transplant ball.ply --part-region near:0,0,-1,0.4 --loop 0 --translate=0,0,2 "
      "--rotate 1,0,0,180 --scale 0.5 --pivot 0,0,-1 --snap --target-region near:0,0,1,0.5 "
      "--transition 0.1 --profile linear --padding 0.05 --belt 0.04 --weights uniform "
      "--sampling one_ring --no-remesh --device cpu --save a.ply --recipe a.recipe.json");
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
  succeed(kFinger +
          "--fit-rotate 30 --fit-scale 0.8 --save a.ply "
          "--recipe a.recipe.json");
  const auto step = std::get<TransplantStep>(read_recipe(file("a.recipe.json")).steps.at(0));
  EXPECT_EQ(std::get<LoopFit>(step.place), (LoopFit{30.0, 0.8, false}));
  expect_refused(kFinger + "--fit-scale 0.8 --keep-size --save b.ply", 3,
                 {"\"keep_size\" and \"scale\" exclude each other"});
  expect_refused(kFinger + "--fit-rotate 30 --snap --save a.ply", 2, {"--snap"});
}

TEST_F(TransplantCommands, WithoutAPartIsAUsageErrorAndWithAClosedOneAMeshError) {
  expect_refused("transplant ball.ply --target-region near:0,0,1,0.5 --save a.ply", 2, {"--part"});
  expect_refused("transplant ball.ply --part ball.ply --target-region near:0,0,1,0.5 --save a.ply",
                 3, {"lapwing cut"});
}

}  // namespace
}  // namespace lapwing
