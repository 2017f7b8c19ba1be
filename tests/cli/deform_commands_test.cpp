// Tests the handles, targets, mirror planes and carried files of `lapwing deform`.
#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "lapwing/io/point_table.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(CommandLine, TargetsComeFromATable) {
  write("marks.csv", "vertex,x,y,z\n100,0.9,0.1,1.5\n");
  const std::string draw = "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --device cpu ";
  succeed(draw +
          "--targets marks.csv --hard-targets --save a.obj "
          "--recipe a.recipe.json --report a.json");
  EXPECT_THAT(read("a.recipe.json"),
              HasSubstr(R"("targets": {"file": "marks.csv", "hard": true})"));
  EXPECT_THAT(read("a.json"), HasSubstr("\"target_error\": 0.0"));
  EXPECT_THAT(read("a.obj"), HasSubstr("v 0.9 0.1 1.5"));
  expect_recipe_repeats("a.recipe.json", "a.obj");
  succeed(draw + "--targets marks.csv --hard-targets --mirror y --save c.obj");
  EXPECT_THAT(read("c.obj"), AllOf(HasSubstr("v 0.9 0.1 1.5"), HasSubstr("v 0.9 -0.1")));
}

TEST_F(CommandLine, MirrorMovesBothSidesAndIsNotedButNoWarning) {
  const std::string squeeze =
      "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --handle near:0.5,0.05,2,0.2 "
      "--translate 0.2,0.1,0.1 --hard --device cpu --strict ";
  EXPECT_THAT(succeed(squeeze + "--mirror x --save a.obj --recipe a.recipe.json "
                                "--report a.json"),
              HasSubstr("note: step 1: mirrored; the mesh is symmetric"));
  EXPECT_THAT(read("a.json"), AllOf(HasSubstr("\"warnings\": []"),
                                    HasSubstr("\"step 1: mirrored; the mesh is symmetric\"")));
  EXPECT_THAT(read("a.recipe.json"), HasSubstr("\"mirror\": {"));
  expect_recipe_repeats("a.recipe.json", "a.obj");
  succeed(squeeze + "--mirror 0,0,0,2,0,0 --save c.obj");
  EXPECT_EQ(read("a.obj"), read("c.obj"));
  succeed(squeeze + "--mirror auto --save d.obj");
}

TEST_F(CommandLine, MirrorThatCannotBeIsAnErrorAndNothingIsWritten) {
  const std::string squeeze =
      "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --translate 0.2,0.1,0.1 --device cpu "
      "--save no.obj --report no.json ";
  const std::string mirror = squeeze + "--handle near:0.5,0.05,2,0.2 --mirror ";
  expect_refused(mirror + "9,0,0,1,0,0", 3,
                 {"does not pass through the mesh; give a point of the plane, or \"auto\""});
  expect_refused(mirror + "0,0,0,0,0,0", 3, {"normal is zero"});
  expect_refused(mirror + "sideways", 2, {"auto | x | y | z | POINT_X,Y,Z,NORMAL_X,Y,Z"});
  expect_refused(mirror + "0,0,0,nan,0,0", 3, {"normal"});
  expect_refused(squeeze + "--handle box:-1,-1,2.8,1,1,4 --mirror 0,0,1.5,0,0,1", 3, {"the belt"});
}

TEST_F(CommandLine, AHandleFallsOffByFlagsAndByARecipe) {
  succeed(kLiftFlags +
          "--rotate 1,0,0,30 --falloff 1 --falloff-profile linear --device cpu "
          "--save a.obj --recipe a.recipe.json");
  EXPECT_THAT(read("a.recipe.json"), HasSubstr(R"("falloff": {"width": 1, "profile": "linear"})"));
  expect_recipe_repeats("a.recipe.json", "a.obj");
  expect_refused(kLiftFlags + "--falloff=-1 --save c.obj", 2);
  expect_refused(kLiftFlags + "--falloff-profile linear --save c.obj", 2);
}

TEST_F(CommandLine, EveryHandleFlagBeginsAHandleWithItsOwnMove) {
  succeed(
      "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --device cpu "
      "--handle box:-1,-1,2.8,1,1,4 --translate 0,0,0.5 --rotate 0,0,1,20 "
      "--handle box:-1,-1,1.4,1,1,1.6 --translate 0.2,0,0 --falloff 0.3 --falloff-profile linear "
      "--handle 60 --recipe a.recipe.json --save a.obj");
  const auto step = nlohmann::json::parse(read("a.recipe.json"))["steps"][0];
  const auto& handles = step["handles"];
  ASSERT_EQ(handles.size(), 3U);
  EXPECT_EQ(handles[0]["move"]["translate"], nlohmann::json({0, 0, 0.5}));
  EXPECT_EQ(handles[0]["move"]["rotate"]["degrees"], 20);
  EXPECT_EQ(handles[1]["region"]["box"]["max"], nlohmann::json({1, 1, 1.6}));
  EXPECT_EQ(handles[1]["move"]["translate"], nlohmann::json({0.2, 0, 0}));
  EXPECT_FALSE(handles[1]["move"].contains("rotate"));
  EXPECT_EQ(handles[1]["falloff"]["profile"], "linear");
  EXPECT_FALSE(handles[0].contains("falloff"));
  EXPECT_FALSE(handles[2].contains("falloff"));
  EXPECT_EQ(handles[2]["region"]["vertices"], nlohmann::json({60}));
  expect_recipe_repeats("a.recipe.json", "a.obj");
}

TEST_F(CommandLine, MoveBeforeTheHandleBelongsToItAndASecondMoveIsRefused) {
  const std::string belt = "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --device cpu ";
  succeed(belt + "--handle box:-1,-1,2.8,1,1,4 --translate -0.1,0,0.5 --save a.obj");
  succeed(belt + "--translate=-0.1,0,0.5 --handle box:-1,-1,2.8,1,1,4 --save b.obj");
  EXPECT_EQ(read("a.obj"), read("b.obj"));
  expect_refused(belt + "--handle 239 --translate 0,0,1 --translate 0,1,0 --save c.obj", 2,
                 {"--translate: is given twice for one move; put the next --handle first"});
  expect_refused(belt + "--translate 0,0,1 --targets marks.csv --save c.obj", 2,
                 {"--handle is required"});
}

TEST_F(CommandLine, PartsAreStiffOrRigid) {
  Mesh mesh = cylinder(12, 20, 0.5, 3.0);
  ExtraAttribute bone{"bone", "float", 1, {}};
  for (const auto& p : mesh.positions) bone.values.push_back(p.z() > 1.5 ? kRigidStiffness : 0.5);
  mesh.edit_attributes().vertex_extras = {bone};
  write_mesh(mesh, file("bones.ply"));
  const std::string lift =
      "deform bones.ply --belt box:-1,-1,-1,1,1,0.4 --handle box:-1,-1,2.5,1,1,4 "
      "--translate 0.5,0,0 --device cpu ";
  succeed(lift +
          "--stiffness rigid box:-1,-1,1,1,1,2 --stiffness 0.5 3,4 --save a.ply "
          "--recipe a.recipe.json");
  const std::string recipe = read("a.recipe.json");
  EXPECT_THAT(recipe, HasSubstr(R"("factor": "rigid")"));
  EXPECT_THAT(recipe, HasSubstr(R"({"region": {"vertices": [3, 4]}, "factor": 0.5})"));
  expect_recipe_repeats("a.recipe.json", "a.ply");
  succeed(lift + "--stiffness-field bone --save b.ply --recipe b.recipe.json");
  EXPECT_THAT(read("b.recipe.json"), HasSubstr("\"field\": ["));
  expect_recipe_repeats("b.recipe.json", "b.ply");
  expect_refused(lift + "--stiffness 0 all --save c.ply", 3,
                 {"/steps/0/stiffness/0/factor: expected a factor from 0.01 to 100"});
  expect_refused(lift + "--stiffness-field bones --save c.ply", 3,
                 {"--stiffness-field: bones.ply has no scalar vertex property \"bones\""});
}

TEST_F(CommandLine, AHandleIsPaintedInAPropertyOfTheMesh) {
  Mesh mesh = cylinder(12, 20, 0.5, 3.0);
  ExtraAttribute firm{"firm", "float", 1, {}};
  for (const auto& p : mesh.positions) {
    firm.values.push_back(std::clamp((p.z() - 1.5) / 1.2, 0.0, 1.0));
  }
  mesh.edit_attributes().vertex_extras = {firm};
  write_mesh(mesh, file("painted.ply"));
  const std::string lift =
      "deform painted.ply --belt box:-1,-1,-1,1,1,0.4 --handle box:-1,-1,0.5,1,1,4 "
      "--translate 0,0,0.5 --device cpu ";
  succeed(lift + "--handle-field firm --save a.ply --recipe a.recipe.json");
  EXPECT_THAT(read("a.recipe.json"), HasSubstr("\"field\": ["));
  expect_recipe_repeats("a.recipe.json", "a.ply");
  expect_refused(lift + "--handle-field frim --save c.ply", 3,
                 {"--handle-field: painted.ply has no scalar vertex property \"frim\""});
  expect_refused(lift + "--handle-field firm --falloff 1 --save c.ply", 2);
}

TEST_F(CommandLine, AHandleWithFalloffThatCannotBeIsAnErrorAndNothingIsWritten) {
  const std::vector<std::array<std::string, 2>> cases{
      {R"("weight": {"field": [1, 0.5]})",
       "/steps/0/handles/0/region: expected a weight for each of the mesh's 240 vertices, got 2"},
      {R"("weight": {"field": [1, 1.5]})", "/weight/field/1"},
      {R"("falloff": {"width": -1})", "/falloff/width"},
      {R"("weight": 0)", "/weight: expected a weight from 0.000001"}};
  for (const auto& [falloff, words] : cases) {
    write("a.json", R"({"lapwing": 1, "mesh": "tube.obj", "steps": [{"op": "deform",
        "roi": {"all": true}, "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.4]}},
        "handles": [{"region": {"vertices": [200]}, "move": {"translate": [0, 0, 1]}, )" +
                        falloff + R"(}]}], "save": "no.obj"})");
    expect_refused("run a.json --device cpu", 3, {words});
  }
}

TEST_F(CommandLine, TargetsThatCannotBeAreNamedByTheirLineAndNothingIsWritten) {
  const std::vector<std::array<std::string, 2>> cases{
      {"100,1,2,3\n100,1,2,4\n", "marks.csv: row 1: vertex 100 has"},
      {"100,1,2,3\n9999,1,2,3\n", "row 1: the mesh has no vertex 9999"},
      {"100,1,nan,3\n", "row 0: its position is not finite"},
      {"100,1,2\n", "marks.csv:1: expected 4 numbers"},
      {"", "no row"}};
  for (const auto& [table, words] : cases) {
    write("marks.csv", table);
    expect_refused("deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --targets marks.csv --save no.obj",
                   3, {words});
  }
}

TEST_F(CommandLine, CarriedFilesAreWrittenBesideTheResult) {
  write("points.csv", "x,y,z,nx,ny,nz\n0.6,0,0.1,1,0,0\n0.6,0,2.9,1,0,0\n");
  write("cloud.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
        "float z\nproperty float nx\nproperty float ny\nproperty float nz\nend_header\n"
        "0 0.6 3 0 1 0\n");
  std::filesystem::create_directory(file("out"));
  const std::string turn =
      "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --device cpu "
      "--handle box:-1,-1,2.6,1,1,4 --rotate 0,0,1,90 --hard ";
  const std::string flags = succeed(turn +
                                    "--carry points.csv --carry cloud.ply --save out/a.obj "
                                    "--recipe a.recipe.json");
  EXPECT_THAT(read("a.recipe.json"), HasSubstr(R"("carry": ["points.csv", "cloud.ply"])"));
  EXPECT_THAT(flags, HasSubstr("wrote out/cloud-carried.ply"));
  const PointTable points = read_point_table(file("out/points-carried.csv"));
  EXPECT_LT((points.positions[0] - Eigen::Vector3d(0.6, 0, 0.1)).norm(), 0.01);
  EXPECT_LT((points.positions[1] - Eigen::Vector3d(0, 0.6, 2.9)).norm(), 0.01);
  EXPECT_LT((points.normals[1] - Eigen::Vector3d(0, 1, 0)).norm(), 0.02);
  const Mesh cloud = read_mesh(file("out/cloud-carried.ply"));
  EXPECT_LT((cloud.positions[0] - Eigen::Vector3d(-0.6, 0, 3)).norm(), 0.01);
  EXPECT_LT((cloud.attributes().normals[0] - Eigen::Vector3d(-1, 0, 0)).norm(), 0.02);

  const std::string carried = read("out/points-carried.csv");
  succeed("run a.recipe.json --device cpu --save out/b.obj");
  EXPECT_EQ(read("out/points-carried.csv"), carried);
  EXPECT_EQ(read("out/a.obj"), read("out/b.obj"));
}

TEST_F(CommandLine, CarriedFileThatCannotBeIsNamedAndNothingIsWritten) {
  const std::string carry = kLiftFlags + "--device cpu --save no.obj --carry ";
  expect_refused(carry + "missing.obj", 6, {"missing.obj"});
  const std::vector<std::array<std::string, 3>> cases{
      {"points.csv", "1,2,3\n1,nan,3\n", "points.csv:2: its position is not finite"},
      {"points.csv", "1,2,3,4\n", "points.csv:1: expected 3 numbers"},
      {"points.csv", "", "no row"},
      {"points.csv", "O.5,0.5,0.1\n0.2,0.2,0.1\n",
       "points.csv:1: expected a number in column 1, found \"O.5\""},
      {"hat.obj", "v 0 0 0\nv 0 nan 0\n", "hat.obj: the position of vertex 1 is not finite"},
      {"hat.obj", "# nothing\n", "no vertices to carry"}};
  for (const auto& [name, content, words] : cases) {
    write(name, content);
    expect_refused(carry + name, 3, {words});
  }
}

const std::string kBendFlags =
    "deform tube.obj --roi all --belt box:-1,-1,-1,1,1,0.3 --handle box:-1,-1,2.7,1,1,4 "
    "--rotate 1,0,0,20 --device cpu --save bent.obj ";

TEST_F(CommandLine, NumbersThatCannotBeComputedWithAreRefused) {
  expect_refused(kBendFlags + "--translate=1e160,0,0", 3, {"handle 0 moves 1e+160"});
  expect_refused(kBendFlags + "--constraint-weight 1e-20", 2,
                 {"a number from 0.000001 to 1000000000000"});
  Mesh huge = cylinder(12, 20, 0.5, 3.0);
  for (Eigen::Vector3d& p : huge.positions) p *= 1e100;
  write_mesh(huge, file("tube.obj"));
  expect_refused("deform tube.obj --handle 239 --translate=1e99,0,0 --device cpu --save bent.obj",
                 3, {"scale the mesh"});
}

TEST_F(CommandLine, HandleThatMissesItsTargetIsReportedAndStrictlyAnError) {
  const std::string loose = kBendFlags + "--constraint-weight 0.001 ";
  EXPECT_THAT(succeed(loose + "--recipe bend.json"), HasSubstr("a handle misses its place by"));
  EXPECT_EQ(lapwing(loose + "--strict").exit_code, 4);
  succeed(kBendFlags + "--strict");
  write("jobs.jsonl", "{\"id\": \"a\"}\n");
  succeed("batch jobs.jsonl --recipe bend.json -o results");
  EXPECT_THAT(read("results/results.jsonl"), HasSubstr("a handle misses its place by"));
}

}  // namespace
}  // namespace lapwing
