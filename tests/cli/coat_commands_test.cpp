// `lapwing coat` and `lapwing peel` as a user meets them.
#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
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

  // The values of a vertex property of a PLY file; none where it has no such property.
  static std::vector<double> values(const Mesh& mesh, const std::string& name) {
    for (const ExtraAttribute& extra : mesh.attributes().vertex_extras) {
      if (extra.name == name) return extra.values;
    }
    return {};
  }
};

const char* const kBumps =
    "coat sheet.ply --source bumps.ply --target-patch near:0.5,0.5,0,0.35 --detail-size 0.5 "
    "--transition 0.1 --device cpu ";

TEST_F(CoatCommands, CoatWritesMeshReportAndRecipeThatRunsToTheSameMesh) {
  const Outcome flags =
      lapwing(std::string(kBumps) + "--save a.ply --report a.json --recipe a.recipe.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(flags.output, AllOf(HasSubstr("coating from 289 vertices"), HasSubstr("residual")));
  const auto report = nlohmann::json::parse(read("a.json"));
  EXPECT_GT(report["steps"][0]["coat"]["largest_displacement"], 0.25 * kHeight);
  const Outcome recipe = lapwing("run a.recipe.json --device cpu --save b.ply --quiet");
  ASSERT_EQ(recipe.exit_code, 0) << recipe.output;
  EXPECT_EQ(recipe.output, "");
  EXPECT_EQ(read("a.ply"), read("b.ply"));
  EXPECT_NE(read("a.ply"), read("sheet.ply"));
}

TEST_F(CoatCommands, EveryFlagOfCoatIsInItsRecipe) {
  const std::string pins =
      "--boundary-pair 0,0 --boundary-pair 16,16 --boundary-pair 288,288 "
      "--boundary-pair 272,272 ";
  const Outcome outcome = lapwing(
      "coat sheet.ply --source bumps.ply --source-patch all --detail-size 0.5 --smooth-target 0.25 "
      "--weights uniform --domain square " +
      pins +
      "--inner-pair 144,145 --inner-pair 100,100 --sampling linear --scale 2 --amplitude=-0.5 "
      "--transition 0.25 --profile linear --no-remesh --device cpu --recipe a.json --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
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
  ASSERT_EQ(lapwing("coat bumps.ply --detail-size 0.5 --device cpu --recipe a.json").exit_code, 0);
  CoatStep expected;
  expected.source.detail_size = 0.5;
  EXPECT_EQ(std::get<CoatStep>(read_recipe(file("a.json")).steps.at(0)), expected);
}

const char* const kMix =
    "mix sheet.ply --first bumps.ply --first-detail-size 0.5 --second-detail-size 0.4 "
    "--target-patch near:0.5,0.5,0,0.35 --device cpu ";

TEST_F(CoatCommands, MixWritesMeshReportAndRecipeThatRunsToTheSameMesh) {
  const Outcome flags = lapwing(std::string(kMix) +
                                "--distance-to near:0.5,0.5,0,0.1 --width 0.1 --transition 0.1 "
                                "--save a.ply --report a.json --recipe a.recipe.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(flags.output, AllOf(HasSubstr("coating from 289 vertices"), HasSubstr("residual")));
  const auto report = nlohmann::json::parse(read("a.json"));
  EXPECT_EQ(report["steps"][0]["mix"]["sources"].size(), 2U);
  ASSERT_EQ(lapwing("run a.recipe.json --device cpu --save b.ply --quiet").exit_code, 0);
  EXPECT_EQ(read("a.ply"), read("b.ply"));
  EXPECT_NE(read("a.ply"), read("sheet.ply"));
}

TEST_F(CoatCommands, EveryFlagOfMixIsInItsRecipe) {
  const Outcome outcome = lapwing(
      std::string(kMix) +
      "--first-patch all --first-inner-pair 144,145 --first-sampling linear --first-scale 2 "
      "--first-amplitude=-0.5 --second sheet.ply --second-patch near:0.5,0.5,0,0.4 "
      "--second-amplitude 3 --take shape --domain square --domain-v 0.25,0.75 --weight-profile "
      "linear --handle 144 --translate 0,0,0.1 --smooth-target 0.25 --weights uniform --transition "
      "0.25 --profile linear --no-remesh --recipe a.json --quiet");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
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
  ASSERT_EQ(lapwing(std::string(kMix) + "--field share --recipe a.json --quiet").exit_code, 0);
  const auto step = std::get<MixStep>(read_recipe(file("a.json")).steps.at(0));
  EXPECT_EQ(std::get<PaintedWeight>(step.weight.form).field,
            std::vector<double>(sheet.vertex_count(), 0.25));
  const Outcome missing = lapwing(std::string(kMix) + "--field shares --recipe a.json");
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.output, HasSubstr("has no scalar vertex property \"shares\""));
}

TEST_F(CoatCommands, MixNeedsAWeight) {
  const Outcome outcome = lapwing(std::string(kMix) + "--recipe a.json");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("one of --domain-v, --distance-to and --field"));
}

TEST_F(CoatCommands, RecipeInAnotherFolderFindsTheSource) {
  std::filesystem::create_directory(file("recipes"));
  const Outcome flags = lapwing(std::string(kBumps) + "--save a.ply --recipe recipes/a.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(read("recipes/a.json"), HasSubstr("\"source\": \"../bumps.ply\""));
  ASSERT_EQ(lapwing("run recipes/a.json --device cpu --save b.ply").exit_code, 0);
  EXPECT_EQ(read("a.ply"), read("b.ply"));
}

TEST_F(CoatCommands, CoatOnTheDeviceDrawsAPatchThatWasRemeshed) {
  LAPWING_NEEDS_GPU();
  write_mesh(grid(6, 6), file("sheet.ply"));
  for (const std::string color : {"regions", "displacement", "rotation"}) {
    const Outcome outcome = lapwing(
        "coat sheet.ply --source bumps.ply --detail-size 0.5 --transition 0.1 --render a.png "
        "--render-before b.png --size 160x120 --color " +
        color);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("patch remeshed from 49 to "));
    EXPECT_THAT(read("a.png"), StartsWith("\x89PNG"));
    EXPECT_NE(read("a.png"), read("b.png"));
  }
}

TEST_F(CoatCommands, WrongArgumentsOfCoatAreUsageErrors) {
  const Outcome nothing_to_write = lapwing(kBumps);
  EXPECT_EQ(nothing_to_write.exit_code, 2);
  EXPECT_THAT(nothing_to_write.output, AllOf(HasSubstr("--save"), HasSubstr("--recipe")));
  const Outcome no_size = lapwing("coat sheet.ply --source bumps.ply --save a.ply");
  EXPECT_EQ(no_size.exit_code, 2);
  EXPECT_THAT(no_size.output, HasSubstr("--detail-size"));
  const std::string save = std::string(kBumps) + "--save a.ply ";
  EXPECT_EQ(lapwing("coat sheet.ply --detail-size 0 --save a.ply").exit_code, 2);
  EXPECT_EQ(lapwing(save + "--smooth-target=-1").exit_code, 2);
  EXPECT_EQ(lapwing(save + "--domain round").exit_code, 2);
  EXPECT_EQ(lapwing(save + "--sampling often").exit_code, 2);
  EXPECT_EQ(lapwing(save + "--inner-pair 3").exit_code, 2);
  EXPECT_EQ(lapwing("coat sheet.ply --detail-size 1 --profile linear --save a.ply").exit_code, 2)
      << "a profile without a transition";
  const Outcome region = lapwing(save + "--source-patch disk:3");
  EXPECT_EQ(region.exit_code, 2);
  EXPECT_THAT(region.output, AllOf(HasSubstr("--source-patch"), HasSubstr("disk:VERTEX,RADIUS")));
  EXPECT_FALSE(std::filesystem::exists(file("a.ply")));
}

TEST_F(CoatCommands, WhatCannotBeCoatedIsNamed) {
  const Outcome missing =
      lapwing("coat sheet.ply --source none.ply --detail-size 1 --device cpu --save a.ply");
  EXPECT_EQ(missing.exit_code, 6);
  EXPECT_THAT(missing.output, HasSubstr("none.ply"));
  write_mesh(cylinder(12, 20, 0.5, 3.0), file("tube.obj"));
  const Outcome tube =
      lapwing("coat tube.obj --source bumps.ply --detail-size 0.5 --device cpu --save a.ply");
  EXPECT_EQ(tube.exit_code, 3);
  EXPECT_THAT(tube.output, AllOf(HasSubstr("target_patch"), HasSubstr("2 boundary loops")));
  const Outcome pairs = lapwing(std::string(kBumps) +
                                "--domain square --boundary-pair 0,0 "
                                "--save a.ply");
  EXPECT_EQ(pairs.exit_code, 3);
  EXPECT_THAT(pairs.output, HasSubstr("the square needs four pairs"));
  EXPECT_FALSE(std::filesystem::exists(file("a.ply")));
}

TEST_F(CoatCommands, PeeledCoatingAddedToTheSmoothMeshGivesTheMeshBack) {
  const Outcome outcome = lapwing("peel bumps.ply --detail-size 0.5 -o smooth.ply");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("225 of 289 vertices smoothed"));
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

TEST_F(CoatCommands, PeeledHeightIsTheCoatingAlongTheNormals) {
  ASSERT_EQ(lapwing("peel bumps.ply --detail-size 0.5 -o vectors.ply").exit_code, 0);
  ASSERT_EQ(lapwing("peel bumps.ply --detail-size 0.5 --coating height -o heights.ply").exit_code,
            0);
  const Mesh mesh = read_mesh(file("heights.ply"));
  const auto height = values(mesh, "coating_height");
  const auto z = values(read_mesh(file("vectors.ply")), "coating_z");
  ASSERT_EQ(height.size(), mesh.vertex_count());
  EXPECT_TRUE(values(mesh, "coating_x").empty());
  // The smooth sheet is nearly flat, so that its normals are nearly the z axis.
  for (std::size_t v = 0; v < height.size(); ++v) EXPECT_NEAR(height[v], z[v], 0.1 * kHeight) << v;
}

TEST_F(CoatCommands, PeelCarriesLaplaciansOrNothingWhenAsked) {
  const std::string peel = "peel bumps.ply --detail-size 0.5 -o a.ply --coating ";
  ASSERT_EQ(lapwing(peel + "displacement").exit_code, 0);
  const Mesh with_displacement = read_mesh(file("a.ply"));
  ASSERT_EQ(lapwing(peel + "laplacians").exit_code, 0);
  const Mesh with_laplacians = read_mesh(file("a.ply"));
  EXPECT_NE(values(with_laplacians, "coating_z"), values(with_displacement, "coating_z"));
  ASSERT_EQ(lapwing(peel + "none").exit_code, 0);
  EXPECT_TRUE(read_mesh(file("a.ply")).attributes().vertex_extras.empty());
}

TEST_F(CoatCommands, PeelLeavesWhatIsOutsideItsRegion) {
  ASSERT_EQ(
      lapwing("peel bumps.ply --detail-size 0.5 --region near:0.5,0.5,0,0.3 -o a.ply").exit_code,
      0);
  const Mesh before = read_mesh(file("bumps.ply"));
  const Mesh after = read_mesh(file("a.ply"));
  double moved = 0.0;
  for (std::size_t v = 0; v < before.vertex_count(); ++v) {
    const double distance = (after.positions[v] - before.positions[v]).norm();
    moved = std::max(moved, distance);
    if ((before.positions[v] - Vector3d(0.5, 0.5, 0.0)).norm() < 0.35) continue;
    EXPECT_EQ(distance, 0.0) << v;
  }
  EXPECT_GT(moved, 0.5 * kHeight);
}

TEST_F(CoatCommands, PeeledAgainHasTheLastCoatingOnly) {
  ASSERT_EQ(lapwing("peel bumps.ply --detail-size 0.2 -o once.ply").exit_code, 0);
  ASSERT_EQ(lapwing("peel once.ply --detail-size 0.5 -o twice.ply").exit_code, 0);
  const Mesh once = read_mesh(file("once.ply"));
  const Mesh twice = read_mesh(file("twice.ply"));
  ASSERT_EQ(twice.attributes().vertex_extras.size(), 3U);
  const auto z = values(twice, "coating_z");
  for (std::size_t v = 0; v < z.size(); ++v) {
    EXPECT_NEAR(twice.positions[v].z() + z[v], once.positions[v].z(), 1e-6);
  }
}

TEST_F(CoatCommands, PeelNamesAVertexThatIsNotFiniteAndWorksAroundIt) {
  Mesh mesh = test::relief(kCells, 3.0, kHeight);
  mesh.positions[144].x() = std::numeric_limits<double>::quiet_NaN();
  write_mesh(mesh, file("broken.ply"));
  const Outcome whole = lapwing("peel broken.ply --detail-size 0.5 -o a.ply");
  EXPECT_EQ(whole.exit_code, 3);
  EXPECT_THAT(whole.output, AllOf(HasSubstr("vertex 144"), HasSubstr("lapwing check --fix")));
  const Outcome rest = lapwing(
      "peel broken.ply --detail-size 0.5 -o a.ply --region "
      "'{\"minus\": [{\"all\": true}, {\"vertices\": [144]}]}'");
  ASSERT_EQ(rest.exit_code, 0) << rest.output;
  EXPECT_THAT(rest.output, ::testing::Not(HasSubstr("nan")));
  for (const double z : values(read_mesh(file("a.ply")), "coating_z")) {
    EXPECT_TRUE(std::isfinite(z));
  }
}

TEST_F(CoatCommands, PeelSaysWhatAFormatCannotCarry) {
  const Outcome outcome = lapwing("peel bumps.ply --detail-size 0.5 -o smooth.obj");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("coating_x"));
}

TEST_F(CoatCommands, WrongArgumentsOfPeelAreUsageErrors) {
  EXPECT_EQ(lapwing("peel bumps.ply -o a.ply").exit_code, 2) << "without a detail size";
  EXPECT_EQ(lapwing("peel bumps.ply --detail-size 0.5").exit_code, 2) << "without an output";
  EXPECT_EQ(lapwing("peel bumps.ply --detail-size=-1 -o a.ply").exit_code, 2);
  EXPECT_EQ(lapwing("peel bumps.ply --detail-size 0.5 --coating fur -o a.ply").exit_code, 2);
  EXPECT_EQ(lapwing("peel bumps.ply --detail-size 0.5 --region disk:3 -o a.ply").exit_code, 2);
  EXPECT_EQ(lapwing("peel none.ply --detail-size 0.5 -o a.ply").exit_code, 6);
  EXPECT_EQ(lapwing("peel bumps.ply --detail-size 0.5 --region 999999 -o a.ply").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(file("a.ply")));
}

}  // namespace
}  // namespace lapwing
