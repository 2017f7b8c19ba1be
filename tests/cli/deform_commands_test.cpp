// Handles, targets, mirrors and carried files of a deform, as a user writes them.
#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "cli/command_line.h"
#include "lapwing/io/point_table.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CommandLine, TargetsComeFromATable) {
  write("marks.csv", "vertex,x,y,z\n100,0.9,0.1,1.5\n");
  const std::string draw = "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --device cpu ";
  const Outcome flags = lapwing(draw +
                                "--targets marks.csv --hard-targets --save a.obj "
                                "--recipe a.recipe.json --report a.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(read("a.recipe.json"),
              HasSubstr(R"("targets": {"file": "marks.csv", "hard": true})"));
  EXPECT_THAT(read("a.json"), HasSubstr("\"target_error\": 0.0"));
  EXPECT_THAT(read("a.obj"), HasSubstr("v 0.9 0.1 1.5"));
  ASSERT_EQ(lapwing("run a.recipe.json --device cpu --save b.obj").exit_code, 0);
  EXPECT_EQ(read("a.obj"), read("b.obj"));
}

TEST_F(CommandLine, MirrorMovesBothSidesAndIsNotedButNoWarning) {
  const std::string squeeze =
      "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --handle near:0.5,0.05,2,0.2 "
      "--translate 0.2,0.1,0.1 --hard --device cpu --strict ";
  const Outcome flags = lapwing(squeeze +
                                "--mirror x --save a.obj --recipe a.recipe.json "
                                "--report a.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(flags.output, HasSubstr("note: step 1: mirrored; the mesh is symmetric"));
  EXPECT_THAT(read("a.json"), AllOf(HasSubstr("\"warnings\": []"),
                                    HasSubstr("\"step 1: mirrored; the mesh is symmetric\"")));
  EXPECT_THAT(read("a.recipe.json"), HasSubstr("\"mirror\": {"));
  const Outcome recipe = lapwing("run a.recipe.json --device cpu --save b.obj");
  ASSERT_EQ(recipe.exit_code, 0) << recipe.output;
  EXPECT_EQ(read("a.obj"), read("b.obj"));
  ASSERT_EQ(lapwing(squeeze + "--mirror 0,0,0,2,0,0 --save c.obj").exit_code, 0);
  EXPECT_EQ(read("a.obj"), read("c.obj"));
  EXPECT_EQ(lapwing(squeeze + "--mirror auto --save d.obj").exit_code, 0);
}

TEST_F(CommandLine, MirrorThatCannotBeIsAnErrorAndNothingIsWritten) {
  const std::string squeeze =
      "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --translate 0.2,0.1,0.1 --device cpu "
      "--save no.obj --report no.json ";
  const auto refused = [&](const std::string& flags, int exit_code) {
    const Outcome outcome = lapwing(squeeze + flags);
    EXPECT_EQ(outcome.exit_code, exit_code) << flags << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(file("no.obj"))) << flags;
    EXPECT_FALSE(std::filesystem::exists(file("no.json"))) << flags;
    return outcome.output;
  };
  const std::string handle = "--handle near:0.5,0.05,2,0.2 ";
  EXPECT_THAT(refused(handle + "--mirror 9,0,0,1,0,0", 3),
              HasSubstr("does not pass through the mesh; give a point of the plane, or \"auto\""));
  EXPECT_THAT(refused(handle + "--mirror 0,0,0,0,0,0", 3), HasSubstr("normal is zero"));
  EXPECT_THAT(refused(handle + "--mirror sideways", 2),
              HasSubstr("auto | x | y | z | POINT_X,Y,Z,NORMAL_X,Y,Z"));
  EXPECT_THAT(refused(handle + "--mirror 0,0,0,nan,0,0", 3), HasSubstr("normal"));
  EXPECT_THAT(refused("--handle box:-1,-1,2.8,1,1,4 --mirror 0,0,1.5,0,0,1", 3),
              HasSubstr("the belt"));
}

TEST_F(CommandLine, MirroredTargetsComeFromATable) {
  write("marks.csv", "vertex,x,y,z\n100,0.9,0.1,1.5\n");
  const Outcome outcome = lapwing(
      "deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --targets marks.csv --hard-targets --mirror y "
      "--device cpu --save a.obj");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(read("a.obj"), AllOf(HasSubstr("v 0.9 0.1 1.5"), HasSubstr("v 0.9 -0.1")));
}

TEST_F(CommandLine, AHandleFallsOffByFlagsAndByARecipe) {
  const Outcome flags =
      lapwing(kLiftFlags +
              "--rotate 1,0,0,30 --falloff 1 --falloff-profile linear --device cpu "
              "--save a.obj --recipe a.recipe.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(read("a.recipe.json"), HasSubstr(R"("falloff": {"width": 1, "profile": "linear"})"));
  ASSERT_EQ(lapwing("run a.recipe.json --device cpu --save b.obj").exit_code, 0);
  EXPECT_EQ(read("a.obj"), read("b.obj"));
  EXPECT_EQ(lapwing(kLiftFlags + "--falloff=-1 --save c.obj").exit_code, 2);
  EXPECT_EQ(lapwing(kLiftFlags + "--falloff-profile linear --save c.obj").exit_code, 2);
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
  const Outcome flags = lapwing(lift + "--handle-field firm --save a.ply --recipe a.recipe.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(read("a.recipe.json"), HasSubstr("\"field\": ["));
  ASSERT_EQ(lapwing("run a.recipe.json --device cpu --save b.ply").exit_code, 0);
  EXPECT_EQ(read("a.ply"), read("b.ply"));
  const Outcome unknown = lapwing(lift + "--handle-field frim --save c.ply");
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.output,
              HasSubstr("--handle-field: painted.ply has no scalar vertex property \"frim\""));
  EXPECT_EQ(lapwing(lift + "--handle-field firm --falloff 1 --save c.ply").exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(file("c.ply")));
}

TEST_F(CommandLine, AHandleWithFalloffThatCannotBeIsAnErrorAndNothingIsWritten) {
  const auto refused = [&](const std::string& falloff) {
    write("a.json", R"({"lapwing": 1, "mesh": "tube.obj", "steps": [{"op": "deform",
        "roi": {"all": true}, "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.4]}},
        "handles": [{"region": {"vertices": [200]}, "move": {"translate": [0, 0, 1]}, )" +
                        falloff + R"(}]}], "save": "no.obj"})");
    const Outcome outcome = lapwing("run a.json --device cpu");
    EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(file("no.obj"))) << falloff;
    return outcome.output;
  };
  EXPECT_THAT(refused(R"("weight": {"field": [1, 0.5]})"),
              HasSubstr("/steps/0/handles/0/region: expected a weight for each of the mesh's 240 "
                        "vertices, got 2"));
  EXPECT_THAT(refused(R"("weight": {"field": [1, 1.5]})"), HasSubstr("/weight/field/1"));
  EXPECT_THAT(refused(R"("falloff": {"width": -1})"), HasSubstr("/falloff/width"));
  EXPECT_THAT(refused(R"("weight": 0)"), HasSubstr("/weight: expected a weight from 0.000001"));
}

TEST_F(CommandLine, TargetsThatCannotBeAreNamedByTheirLineAndNothingIsWritten) {
  const auto refused = [&](const std::string& table) {
    write("marks.csv", table);
    const Outcome outcome =
        lapwing("deform tube.obj --belt box:-1,-1,-1,1,1,0.4 --targets marks.csv --save no.obj");
    EXPECT_EQ(outcome.exit_code, 3) << table;
    EXPECT_FALSE(std::filesystem::exists(file("no.obj"))) << table;
    return outcome.output;
  };
  EXPECT_THAT(refused("100,1,2,3\n100,1,2,4\n"), HasSubstr("marks.csv: row 1: vertex 100 has"));
  EXPECT_THAT(refused("100,1,2,3\n9999,1,2,3\n"), HasSubstr("row 1: the mesh has no vertex 9999"));
  EXPECT_THAT(refused("100,1,nan,3\n"), HasSubstr("row 0: its position is not finite"));
  EXPECT_THAT(refused("100,1,2\n"), HasSubstr("marks.csv:1: expected 4 numbers"));
  EXPECT_THAT(refused(""), HasSubstr("no row"));
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
  const Outcome flags = lapwing(turn +
                                "--carry points.csv --carry cloud.ply --save out/a.obj "
                                "--recipe a.recipe.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(read("a.recipe.json"), HasSubstr(R"("carry": ["points.csv", "cloud.ply"])"));
  EXPECT_THAT(flags.output, HasSubstr("wrote out/cloud-carried.ply"));
  const PointTable points = read_point_table(file("out/points-carried.csv"));
  EXPECT_LT((points.positions[0] - Eigen::Vector3d(0.6, 0, 0.1)).norm(), 0.01);
  EXPECT_LT((points.positions[1] - Eigen::Vector3d(0, 0.6, 2.9)).norm(), 0.01);
  EXPECT_LT((points.normals[1] - Eigen::Vector3d(0, 1, 0)).norm(), 0.02);
  const Mesh cloud = read_mesh(file("out/cloud-carried.ply"));
  EXPECT_LT((cloud.positions[0] - Eigen::Vector3d(-0.6, 0, 3)).norm(), 0.01);
  EXPECT_LT((cloud.attributes().normals[0] - Eigen::Vector3d(-1, 0, 0)).norm(), 0.02);

  const std::string carried = read("out/points-carried.csv");
  ASSERT_EQ(lapwing("run a.recipe.json --device cpu --save out/b.obj").exit_code, 0);
  EXPECT_EQ(read("out/points-carried.csv"), carried);
  EXPECT_EQ(read("out/a.obj"), read("out/b.obj"));
}

TEST_F(CommandLine, CarriedFileThatCannotBeIsNamedAndNothingIsWritten) {
  const auto refused = [&](const std::string& name, int exit_code) {
    const Outcome outcome = lapwing(kLiftFlags + "--device cpu --save no.obj --carry " + name);
    EXPECT_EQ(outcome.exit_code, exit_code) << name << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(file("no.obj"))) << name;
    return outcome.output;
  };
  EXPECT_THAT(refused("missing.obj", 6), HasSubstr("missing.obj"));
  write("points.csv", "1,2,3\n1,nan,3\n");
  EXPECT_THAT(refused("points.csv", 3), HasSubstr("points.csv:2: its position is not finite"));
  write("points.csv", "1,2,3,4\n");
  EXPECT_THAT(refused("points.csv", 3), HasSubstr("points.csv:1: expected 3 numbers"));
  write("points.csv", "");
  EXPECT_THAT(refused("points.csv", 3), HasSubstr("no row"));
  write("hat.obj", "v 0 0 0\nv 0 nan 0\n");
  EXPECT_THAT(refused("hat.obj", 3), HasSubstr("hat.obj: the position of vertex 1 is not finite"));
  write("hat.obj", "# nothing\n");
  EXPECT_THAT(refused("hat.obj", 3), HasSubstr("no vertices to carry"));
}

}  // namespace
}  // namespace lapwing
