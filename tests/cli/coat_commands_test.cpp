// Tests `lapwing coat`, `lapwing mix` and `lapwing peel`.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "coating/coating_scenes.h"
#include "lapwing/recipe/recipe.h"
#include "support/bent_tube.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr Index kCells = 16;
constexpr double kHeight = 0.02;

class CoatCommands : public CommandLine {
 protected:
  void SetUp() override {
    write_mesh(test::relief(kCells, 3.0, kHeight), file("bumps.ply"));
    write_mesh(grid(kCells, kCells), file("sheet.ply"));
  }

  // Returns the values of a vertex property, or none if there is no such property.
  static std::vector<double> values(const Mesh& mesh, const std::string& name) {
    for (const ExtraAttribute& extra : mesh.attributes().vertex_extras) {
      if (extra.name == name) return extra.values;
    }
    return {};
  }
};

const std::string kBumps =
    "coat sheet.ply --source bumps.ply --target-patch near:0.5,0.5,0,0.35 --detail-size 0.5 "
    "--transition 0.1 --device cpu ";

TEST_F(CoatCommands, CoatWritesMeshReportAndRecipeThatRunsToTheSameMesh) {
  EXPECT_THAT(succeed(kBumps + "--save a.ply --report a.json --recipe a.recipe.json"),
              AllOf(HasSubstr("coating from 289 vertices"), HasSubstr("residual")));
  const auto report = nlohmann::json::parse(read("a.json"));
  EXPECT_GT(report["steps"][0]["coat"]["largest_displacement"], 0.25 * kHeight);
  expect_recipe_repeats("a.recipe.json", "a.ply");
  EXPECT_NE(read("a.ply"), read("sheet.ply"));
}

TEST_F(CoatCommands, EveryFlagOfCoatIsInItsRecipe) {
  const std::string pins =
      "--boundary-pair 0,0 --boundary-pair 16,16 --boundary-pair 288,288 "
      "--boundary-pair 272,272 ";
  succeed(
      "coat sheet.ply --source bumps.ply --source-patch all --detail-size 0.5 --smooth-target 0.25 "
      "--weights uniform --domain square " +
      pins +
      "--inner-pair 144,145 --inner-pair 100,100 --sampling linear --scale 2 --amplitude=-0.5 "
      "--transition 0.25 --profile linear --no-remesh --device cpu --recipe a.json --quiet");
  const Recipe recipe = read_recipe(file("a.json"));
  EXPECT_EQ(recipe.mesh, "sheet.ply");
  CoatStep expected;
  expected.source.mesh = "bumps.ply";
  expected.source.detail_size = 0.5;
  expected.parameters.smooth_target = 0.25;
  expected.parameters.weights = LaplacianWeights::uniform;
  expected.parameters.domain = Domain::square;
  expected.source.boundary_pairs = {{0, 0}, {16, 16}, {288, 288}, {272, 272}};
  expected.source.inner_pairs = {{144, 145}, {100, 100}};
  expected.source.sampling = {MappedSampling::linear, 2.0};
  expected.source.amplitude = -0.5;
  expected.parameters.transition = Transition{0.25, Transition::Profile::linear};
  expected.parameters.remesh = Remeshing::none;
  EXPECT_EQ(std::get<CoatStep>(recipe.steps.at(0)), expected);
}

TEST_F(CoatCommands, CoatFlagsLeftOutAreTheRecipesDefaults) {
  succeed("coat bumps.ply --detail-size 0.5 --device cpu --recipe a.json");
  CoatStep expected;
  expected.source.detail_size = 0.5;
  EXPECT_EQ(std::get<CoatStep>(read_recipe(file("a.json")).steps.at(0)), expected);
}

const std::string kMix =
    "mix sheet.ply --first bumps.ply --first-detail-size 0.5 --second-detail-size 0.4 "
    "--target-patch near:0.5,0.5,0,0.35 --device cpu ";

TEST_F(CoatCommands, MixWritesMeshReportAndRecipeThatRunsToTheSameMesh) {
  EXPECT_THAT(succeed(kMix + "--distance-to near:0.5,0.5,0,0.1 --width 0.1 --transition 0.1 "
                             "--save a.ply --report a.json --recipe a.recipe.json"),
              AllOf(HasSubstr("coating from 289 vertices"), HasSubstr("residual")));
  const auto report = nlohmann::json::parse(read("a.json"));
  EXPECT_EQ(report["steps"][0]["mix"]["sources"].size(), 2U);
  expect_recipe_repeats("a.recipe.json", "a.ply");
  EXPECT_NE(read("a.ply"), read("sheet.ply"));
}

TEST_F(CoatCommands, EveryFlagOfMixIsInItsRecipe) {
  succeed(
      kMix +
      "--first-patch all --first-inner-pair 144,145 --first-sampling linear --first-scale 2 "
      "--first-amplitude=-0.5 --second sheet.ply --second-patch near:0.5,0.5,0,0.4 "
      "--second-amplitude 3 --take shape --domain square --domain-v 0.25,0.75 --weight-profile "
      "linear --handle 144 --translate 0,0,0.1 --smooth-target 0.25 --weights uniform --transition "
      "0.25 --profile linear --no-remesh --recipe a.json --quiet");
  MixStep expected;
  expected.target_patch = {GeodesicDisk{Vector3d(0.5, 0.5, 0.0), 0.35}};
  FileSource& first = expected.sources[0];
  first.mesh = "bumps.ply";
  first.detail_size = 0.5;
  first.inner_pairs = {{144, 145}};
  first.sampling = {MappedSampling::linear, 2.0};
  first.amplitude = -0.5;
  FileSource& second = expected.sources[1];
  second.mesh = "sheet.ply";
  second.patch = {GeodesicDisk{Vector3d(0.5, 0.5, 0.0), 0.4}};
  second.detail_size = 0.4;
  second.amplitude = 3.0;
  expected.transfer = TransferMode::shape;
  expected.weight = {DomainRamp{0.25, 0.75}, Transition::Profile::linear};
  expected.handles.push_back({{ListedVertices{{144}}}, SimilarityMove{{0.0, 0.0, 0.1}}});
  expected.parameters.smooth_target = 0.25;
  expected.parameters.weights = LaplacianWeights::uniform;
  expected.parameters.domain = Domain::square;
  expected.parameters.transition = Transition{0.25, Transition::Profile::linear};
  expected.parameters.remesh = Remeshing::none;
  EXPECT_EQ(std::get<MixStep>(read_recipe(file("a.json")).steps.at(0)), expected);
}

TEST_F(CoatCommands, MixTakesItsWeightFromAPropertyOfTheMesh) {
  Mesh sheet = grid(kCells, kCells);
  sheet.edit_attributes().vertex_extras.push_back(
      {"share", "double", 1, std::vector<double>(sheet.vertex_count(), 0.25)});
  write_mesh(sheet, file("sheet.ply"));
  succeed(kMix + "--field share --recipe a.json --quiet");
  const auto step = std::get<MixStep>(read_recipe(file("a.json")).steps.at(0));
  EXPECT_EQ(std::get<PaintedWeight>(step.weight.form).field,
            std::vector<double>(sheet.vertex_count(), 0.25));
  expect_refused(kMix + "--field shares --recipe a.json", 3,
                 {"has no scalar vertex property \"shares\""});
}

TEST_F(CoatCommands, MixNeedsAWeight) {
  expect_refused(kMix + "--recipe a.json", 2, {"one of --domain-v, --distance-to and --field"});
}

TEST_F(CoatCommands, RecipeInAnotherFolderFindsTheSource) {
  std::filesystem::create_directory(file("recipes"));
  succeed(kBumps + "--save a.ply --recipe recipes/a.json");
  EXPECT_THAT(read("recipes/a.json"), HasSubstr("\"source\": \"../bumps.ply\""));
  expect_recipe_repeats("recipes/a.json", "a.ply");
}

TEST_F(CoatCommands, CoatOnTheDeviceDrawsAPatchThatWasRemeshed) {
  LAPWING_NEEDS_GPU();
  write_mesh(grid(6, 6), file("sheet.ply"));
  for (const std::string color : {"regions", "displacement", "rotation"}) {
    EXPECT_THAT(
        succeed(
            "coat sheet.ply --source bumps.ply --detail-size 0.5 --transition 0.1 --render a.png "
            "--render-before b.png --size 160x120 --color " +
            color),
        HasSubstr("patch remeshed from 49 to "));
    EXPECT_THAT(read("a.png"), StartsWith("\x89PNG"));
    EXPECT_NE(read("a.png"), read("b.png"));
  }
}

TEST_F(CoatCommands, WrongArgumentsOfCoatAreUsageErrors) {
  expect_refused(kBumps, 2, {"--save", "--recipe"});
  expect_refused("coat sheet.ply --source bumps.ply --save a.ply", 2, {"--detail-size"});
  expect_refused("coat sheet.ply --detail-size 0 --save a.ply", 2);
  // --profile is an error without a transition.
  expect_refused("coat sheet.ply --detail-size 1 --profile linear --save a.ply", 2);
  const std::string save = kBumps + "--save a.ply ";
  for (const char* flags :
       {"--smooth-target=-1", "--domain round", "--sampling often", "--inner-pair 3"}) {
    expect_refused(save + flags, 2);
  }
  expect_refused(save + "--source-patch disk:3", 2, {"--source-patch", "disk:VERTEX,RADIUS"});
}

TEST_F(CoatCommands, WhatCannotBeCoatedIsNamed) {
  expect_refused("coat sheet.ply --source none.ply --detail-size 1 --device cpu --save a.ply", 6,
                 {"none.ply"});
  write_mesh(cylinder(12, 20, 0.5, 3.0), file("tube.obj"));
  expect_refused("coat tube.obj --source bumps.ply --detail-size 0.5 --device cpu --save a.ply", 3,
                 {"target_patch", "2 boundary loops"});
  expect_refused(kBumps +
                     "--domain square --boundary-pair 0,0 "
                     "--save a.ply",
                 3, {"the square needs four pairs"});
}

TEST_F(CoatCommands, PeeledCoatingAddedToTheSmoothMeshGivesTheMeshBack) {
  EXPECT_THAT(succeed("peel bumps.ply --detail-size 0.5 -o smooth.ply"),
              HasSubstr("225 of 289 vertices smoothed"));
  const Mesh bumps = read_mesh(file("bumps.ply"));
  Mesh smooth = read_mesh(file("smooth.ply"));
  const auto x = values(smooth, "coating_x");
  const auto y = values(smooth, "coating_y");
  const auto z = values(smooth, "coating_z");
  ASSERT_EQ(z.size(), bumps.vertex_count());
  EXPECT_GT(*std::max_element(z.begin(), z.end()), 0.5 * kHeight);
  for (std::size_t v = 0; v < z.size(); ++v) smooth.positions[v] += Vector3d(x[v], y[v], z[v]);
  EXPECT_LT(test::largest_distance(smooth.positions, bumps.positions), 1e-6);
}

TEST_F(CoatCommands, PeelCarriesTheCoatingInTheFormAskedFor) {
  const auto peeled = [&](const std::string& form) {
    succeed("peel bumps.ply --detail-size 0.5 -o a.ply --coating " + form);
    return read_mesh(file("a.ply"));
  };
  const Mesh with_displacement = peeled("displacement");
  EXPECT_NE(values(peeled("laplacians"), "coating_z"), values(with_displacement, "coating_z"));
  const Mesh with_height = peeled("height");
  EXPECT_EQ(values(with_height, "coating_height").size(), with_height.vertex_count());
  EXPECT_TRUE(values(with_height, "coating_x").empty());
  EXPECT_TRUE(peeled("none").attributes().vertex_extras.empty());
}

TEST_F(CoatCommands, PeelSaysWhatAFormatCannotCarry) {
  EXPECT_THAT(succeed("peel bumps.ply --detail-size 0.5 -o smooth.obj"), HasSubstr("coating_x"));
}

TEST_F(CoatCommands, WrongArgumentsOfPeelAreUsageErrors) {
  expect_refused("peel bumps.ply -o a.ply", 2, {"--detail-size is required"});
  expect_refused("peel bumps.ply --detail-size 0.5", 2, {"--output is required"});
  expect_refused("peel bumps.ply --detail-size=-1 -o a.ply", 2);
  for (const char* flags : {"--coating fur", "--region disk:3"}) {
    expect_refused(std::string("peel bumps.ply --detail-size 0.5 -o a.ply ") + flags, 2);
  }
  expect_refused("peel none.ply --detail-size 0.5 -o a.ply", 6);
  expect_refused("peel bumps.ply --detail-size 0.5 --region 999999 -o a.ply", 3);
}

}  // namespace
}  // namespace lapwing
