// The command line as a user meets it: run as a program, judged by exit code, output and files.
#include <algorithm>
#include <set>

#include <gmock/gmock.h>

#include "cli/command_line.h"
#include "support/gpu.h"
#include "support/split_meshes.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CommandLine, DeformByFlagsWritesMeshReportAndRecipeThatRunsToTheSameMesh) {
  const Outcome flags =
      lapwing(kLiftFlags + "--device cpu --save a.obj --report a.json --recipe a.recipe.json");
  ASSERT_EQ(flags.exit_code, 0) << flags.output;
  EXPECT_THAT(read("a.json"), AllOf(HasSubstr("\"certificate\""), HasSubstr("\"laplacian\"")));
  const Outcome recipe = lapwing("run a.recipe.json --device cpu --save b.obj --quiet");
  ASSERT_EQ(recipe.exit_code, 0) << recipe.output;
  EXPECT_EQ(recipe.output, "");
  EXPECT_EQ(read("a.obj"), read("b.obj"));
}

TEST_F(CommandLine, LargeTurnIsMadeInPartsByItselfOrAsAsked) {
  const std::string turn = kLiftFlags + "--rotate 0,0,1,260 --device cpu --save a.obj ";
  const Outcome by_itself = lapwing(turn);
  ASSERT_EQ(by_itself.exit_code, 0) << by_itself.output;
  EXPECT_THAT(by_itself.output, HasSubstr("3 commits"));
  EXPECT_THAT(by_itself.output, Not(HasSubstr("--commit-every")));
  const Outcome committed = lapwing(turn + "--commit-every 130 --recipe a.recipe.json");
  ASSERT_EQ(committed.exit_code, 0) << committed.output;
  EXPECT_THAT(committed.output, HasSubstr("2 commits"));
  EXPECT_THAT(read("a.recipe.json"), HasSubstr("\"commit_every\": 130"));
  EXPECT_EQ(lapwing(turn + "--commit-every 200").exit_code, 2);
}

TEST_F(CommandLine, StrictTellsTheShellOfAResultWithWarningsAndWritesItAllTheSame) {
  const std::string good = kLiftFlags + "--device cpu --strict ";
  EXPECT_EQ(lapwing(good + "--save a.obj").exit_code, 0);
  const std::string cut_short = kLiftFlags +
                                "--rotate 1,0,0,80 --max-iterations 1 --device cpu --save b.obj "
                                "--report b.json ";
  const Outcome told = lapwing(cut_short);
  EXPECT_EQ(told.exit_code, 0) << told.output;
  EXPECT_THAT(told.output, HasSubstr("not settled after 1 iterations"));
  EXPECT_THAT(read("b.json"), HasSubstr("not settled after 1 iterations"));
  const std::string written = read("b.obj");
  const Outcome strict = lapwing(cut_short + "--strict");
  EXPECT_EQ(strict.exit_code, 4) << strict.output;
  EXPECT_EQ(read("b.obj"), written);
}

TEST_F(CommandLine, ReportHoldsEveryVertexWhenAsked) {
  const std::string report = kLiftFlags + "--device cpu --report a.json ";
  ASSERT_EQ(lapwing(report).exit_code, 0);
  EXPECT_THAT(read("a.json"), Not(HasSubstr("\"rotation_degrees\"")));
  ASSERT_EQ(lapwing(report + "--report-vertices").exit_code, 0);
  EXPECT_THAT(read("a.json"), AllOf(HasSubstr("\"rotation_degrees\""),
                                    HasSubstr("\"displacement\""), HasSubstr("\"rotation\"")));
  EXPECT_EQ(lapwing(kLiftFlags + "--save a.obj --report-vertices").exit_code, 2);
}

TEST_F(CommandLine, VertexMotionIsSavedAsPropertiesOfAPlyAlone) {
  const std::string lift = kLiftFlags + "--device cpu --vertex-motion ";
  ASSERT_EQ(lapwing(lift + "--save a.ply").exit_code, 0);
  EXPECT_THAT(read("a.ply"), HasSubstr("property double qw\nproperty double qx"));
  const Outcome refused = lapwing(lift + "--save a.obj");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("a.obj cannot store it; use --save with a .ply file"));
  EXPECT_FALSE(std::filesystem::exists(file("a.obj")));
  EXPECT_THAT(lapwing(lift + "--report a.json").output, HasSubstr("nothing is saved"));
}

TEST_F(CommandLine, EditOnTheDeviceDrawsBothPictures) {
  LAPWING_NEEDS_GPU();
  const Outcome outcome =
      lapwing(kLiftFlags + "--render a.png --render-before b.png --size 160x120");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(read("a.png"), ::testing::StartsWith("\x89PNG"));
  EXPECT_NE(read("a.png"), read("b.png"));
}

TEST_F(CommandLine, RenderDrawsAMeshAndHowItDiffersFromItsRestPose) {
  LAPWING_NEEDS_GPU();
  ASSERT_EQ(lapwing(kLiftFlags + "--device cpu --save a.obj").exit_code, 0);
  const std::string render = "render a.obj -o a.png --size 160x120 ";
  ASSERT_EQ(lapwing(render).exit_code, 0);
  std::set<std::string> pictures{read("a.png")};
  for (const std::string color : {"displacement", "rotation", "detail", "stretch"}) {
    ASSERT_EQ(lapwing(render + "--rest tube.obj --color " + color).exit_code, 0);
    EXPECT_TRUE(pictures.insert(read("a.png")).second) << color << " looks like another one";
  }
  EXPECT_EQ(lapwing(render + "--color rotation").exit_code, 2) << "without --rest";
}

TEST_F(CommandLine, RenderShowsTheColorsOfTheFileAndSaysWhatIsMissing) {
  LAPWING_NEEDS_GPU();
  write("a.mtl", "newmtl skin\nKd 1 0 0\nmap_Kd gone.png\n");
  write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl skin\nf 1/1 2/1 3/1\n");
  const std::string render = "render a.obj -o a.png --size 160x120 ";
  const Outcome red = lapwing(render);
  ASSERT_EQ(red.exit_code, 0) << red.output;
  EXPECT_EQ(red.output, "lapwing: note: image 'gone.png' is not beside a.mtl; put it there\n");
  const std::string picture = read("a.png");
  EXPECT_EQ(lapwing(render + "--color file").exit_code, 0);
  EXPECT_EQ(read("a.png"), picture);
  EXPECT_EQ(lapwing(render + "--color plain").output, "");
  EXPECT_NE(read("a.png"), picture);
  EXPECT_EQ(lapwing(render + "--color file --rest a.obj").exit_code, 2) << "no difference";
}

TEST_F(CommandLine, EditDrawsHowItsResultDiffersFromWhatWasThere) {
  LAPWING_NEEDS_GPU();
  std::set<std::string> pictures;
  for (const std::string color : {"plain", "regions", "displacement", "rotation", "detail"}) {
    const Outcome outcome = lapwing(kLiftFlags + "--render a.png --size 160x120 --color " + color);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_TRUE(pictures.insert(read("a.png")).second) << color << " looks like another one";
  }
}

TEST_F(CommandLine, WithoutTheLoaderOnlyTheCpuWorks) {
  const std::string no_loader = "LAPWING_VULKAN_LOADER=/nonexistent/libvulkan.so";
  const Outcome device = lapwing(kLiftFlags + "--save a.obj", no_loader);
  EXPECT_EQ(device.exit_code, 5);
  EXPECT_THAT(device.output, AllOf(HasSubstr("mesa-vulkan-drivers"), HasSubstr("--device cpu")));
  EXPECT_FALSE(std::filesystem::exists(file("a.obj")));
  EXPECT_EQ(lapwing(kLiftFlags + "--device cpu --save a.obj", no_loader).exit_code, 0);
}

TEST_F(CommandLine, DeviceThatDoesNotExistIsRefusedWithTheOnesThatDo) {
  LAPWING_NEEDS_GPU();
  const Outcome outcome = lapwing(kLiftFlags + "--save a.obj --device nosuchdevice");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.output, HasSubstr("nosuchdevice"));
}

TEST_F(CommandLine, WrongArgumentsAreUsageErrors) {
  EXPECT_EQ(lapwing("").exit_code, 2);
  EXPECT_EQ(lapwing("fly tube.obj").exit_code, 2);
  EXPECT_THAT(lapwing("deform tube.obj --save a.obj").output, HasSubstr("--targets"));
  EXPECT_EQ(lapwing("deform tube.obj --save a.obj").exit_code, 2);
  const Outcome region = lapwing("deform tube.obj --handle disk:3 --save a.obj --device cpu");
  EXPECT_EQ(region.exit_code, 2);
  EXPECT_THAT(region.output, AllOf(HasSubstr("--handle"), HasSubstr("disk:VERTEX,RADIUS")));
  EXPECT_EQ(lapwing(kLiftFlags + "--render a.png --size 12by3").exit_code, 2);
}

TEST_F(CommandLine, HelpAndVersionSucceed) {
  EXPECT_EQ(lapwing("--help").exit_code, 0);
  EXPECT_EQ(lapwing("--version").exit_code, 0);
  EXPECT_THAT(lapwing("deform --help").output, HasSubstr("--handle"));
}

TEST_F(CommandLine, EveryKeyOfADeformIsAFlag) {
  const Outcome outcome = lapwing(kLiftFlags +
                                  "--weights uniform --detail-length 0.2 --response rsi "
                                  "--constraint-weight 2 --hard --tolerance 0.001 "
                                  "--max-iterations 50 --commit-every 90 --recipe a.recipe.json "
                                  "--device cpu --save a.obj");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* key :
       {"\"weights\": \"uniform\"", "\"detail_length\": 0.2", "\"response\": \"rsi\"",
        "\"constraint_weight\": 2", "\"hard\": true", "\"tolerance\": 0.001",
        "\"max_iterations\": 50", "\"commit_every\": 90"}) {
    EXPECT_THAT(read("a.recipe.json"), HasSubstr(key));
  }
}

TEST_F(CommandLine, SplitVerticesComeBackWithTheirFacesAndTextureCoordinates) {
  // The tube in two charts, each with its own vertices and texture coordinates.
  const test::SplitMesh split = test::halves(read_mesh(file("tube.obj")));
  std::ostringstream obj;
  obj.precision(17);
  for (const auto& p : split.mesh.positions) {
    obj << "v " << p.transpose() << "\nvt " << p.x() << " " << p.z() << "\n";
  }
  for (std::size_t f = 0; f < split.mesh.face_count(); ++f) {
    if (2 * f == split.mesh.face_count()) obj << "usemtl second # chart\n";
    obj << "f";
    for (const Index v : split.mesh.face(f)) obj << " " << v + 1 << "/" << v + 1;
    obj << "\n";
  }
  write("charts.obj", obj.str());
  const std::string move =
      " --belt box:-1,-1,-1,1,1,0.4 --handle box:-1,-1,2.6,1,1,9 --translate=0.4,0,-0.2 "
      "--device cpu --save ";
  const Outcome outcome = lapwing("deform charts.obj" + move + "a.obj --strict");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("seam edges of the ROI are joined"));
  const auto without_positions = [&](const std::string& name) {
    std::istringstream lines(read(name));
    std::string kept;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("v ")) kept += line + "\n";
    }
    return kept;
  };
  EXPECT_EQ(without_positions("a.obj"), without_positions("charts.obj"));
  ASSERT_EQ(lapwing("deform tube.obj" + move + "whole.obj").exit_code, 0);
  const Positions after = read_mesh(file("a.obj")).positions;
  const Positions whole = read_mesh(file("whole.obj")).positions;
  for (std::size_t v = 0; v < after.size(); ++v) EXPECT_EQ(after[v], whole[split.sources[v]]);
}

TEST_F(CommandLine, ReportMeasuresASoupAsTheSurfaceThatItIs) {
  write_mesh(test::soup(read_mesh(file("tube.obj"))).mesh, file("soup.obj"));
  const std::string bend =
      " --belt box:-1,-1,-1,1,1,0.4 --handle box:-1,-1,2.6,1,1,9 --translate=0.4,0,-0.2 "
      "--device cpu --report-vertices --report ";
  std::vector<double> largest;
  for (const std::string name : {"tube", "soup"}) {
    const Outcome outcome = lapwing("deform " + name + ".obj" + bend + name + ".json");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    const std::string report = read(name + ".json");
    const auto list = report.find("\"detail_error\"", report.find("\"rotation_degrees\""));
    ASSERT_NE(list, std::string::npos);
    std::istringstream numbers(report.substr(report.find('[', list) + 1));
    double most = 0.0;
    for (double number = 0.0; numbers >> number; numbers.ignore()) most = std::max(most, number);
    largest.push_back(most);
  }
  EXPECT_GT(largest[0], 0.01);
  EXPECT_NEAR(largest[0], largest[1], 1e-9);
}

TEST_F(CommandLine, FlagOutOfItsRangeIsAUsageErrorThatSaysTheRange) {
  const Outcome length = lapwing(kLiftFlags + "--detail-length 0 --save a.obj");
  EXPECT_EQ(length.exit_code, 2);
  EXPECT_THAT(length.output,
              AllOf(HasSubstr("--detail-length"), HasSubstr("a number from 0.000001 to 1000")));
  const Outcome iterations = lapwing(kLiftFlags + "--max-iterations 1.5 --save a.obj");
  EXPECT_EQ(iterations.exit_code, 2);
  EXPECT_THAT(iterations.output, HasSubstr("a whole number from 1 to 1000000, got 1.5"));
  EXPECT_EQ(lapwing(kLiftFlags + "--no-settle --tolerance 0.1 --save a.obj").exit_code, 2);
}

TEST_F(CommandLine, KeysTellsWhatAStepTakes) {
  const Outcome all = lapwing("keys");
  EXPECT_EQ(all.exit_code, 0);
  EXPECT_THAT(all.output, AllOf(HasSubstr("deform: "), HasSubstr("transplant: "),
                                HasSubstr("| `settle.tolerance` | a number above 0 | 0.0001 |")));
  EXPECT_THAT(lapwing("keys coat").output, Not(HasSubstr("deform: ")));
  EXPECT_EQ(lapwing("keys fly").exit_code, 2);
}

TEST_F(CommandLine, BrokenFilesNameFileAndLine) {
  write("bad.obj", "v 0 0 0\nv 1 0 zero\n");
  const Outcome mesh = lapwing("check bad.obj");
  EXPECT_EQ(mesh.exit_code, 3);
  EXPECT_THAT(mesh.output, HasSubstr("bad.obj:2"));
  write("bad.json", "{\"lapwing\": 1,\n \"mesh\": }");
  const Outcome recipe = lapwing("run bad.json");
  EXPECT_EQ(recipe.exit_code, 3);
  EXPECT_THAT(recipe.output, HasSubstr("bad.json:2"));
  write("typo.json", R"({"lapwing": 1, "mesh": "tube.obj", "step": []})");
  EXPECT_THAT(lapwing("run typo.json").output, AllOf(HasSubstr("step"), HasSubstr("steps")));
}

TEST_F(CommandLine, FilesThatCannotBeReadOrWrittenAreFileErrors) {
  EXPECT_EQ(lapwing("check nothing-here.obj").exit_code, 6);
  EXPECT_EQ(lapwing("convert tube.obj nowhere/tube.ply").exit_code, 6);
}

TEST_F(CommandLine, ConvertSaysWhatItCannotCarry) {
  write("red.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\n");
  const Outcome outcome = lapwing("convert red.obj red.off");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("material"));
}

TEST_F(CommandLine, ShapesAreMadeAndSubdivided) {
  ASSERT_EQ(lapwing("shape bar -o bar.obj").exit_code, 0);
  const Mesh bar = read_mesh(file("bar.obj"));
  ASSERT_EQ(lapwing("subdivide bar.obj -o fine.obj").exit_code, 0);
  const Mesh fine = read_mesh(file("fine.obj"));
  EXPECT_EQ(fine.face_count(), 4 * bar.face_count());
  EXPECT_EQ(fine.positions[0], bar.positions[0]) << "a corner";
  ASSERT_EQ(lapwing("subdivide bar.obj -o round.obj --smooth --times 2").exit_code, 0);
  const Mesh round = read_mesh(file("round.obj"));
  EXPECT_EQ(round.face_count(), 16 * bar.face_count());
  EXPECT_NE(round.positions[0], bar.positions[0]) << "a corner";
  const Outcome unknown = lapwing("shape teapot -o a.obj");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("bumpy-plane"));
}

TEST_F(CommandLine, RegionIsLaidIntoThePlane) {
  const std::string lay = "parameterize tube.obj --region disk:120,0.6 ";
  const Outcome outcome = lapwing(lay + "-o flat.obj --picture flat.png --size 200");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("flipped  0 triangles"), HasSubstr("pins")));
  const Mesh flat = read_mesh(file("flat.obj"));
  EXPECT_GT(flat.attributes().uvs.size(), 5U);
  EXPECT_THAT(read("flat.png"), ::testing::StartsWith("\x89PNG"));
  ASSERT_EQ(lapwing(lay + "--domain square --picture square.png --size 200").exit_code, 0);
  EXPECT_NE(read("square.png"), read("flat.png"));
}

TEST_F(CommandLine, WhatCannotBeLaidIntoThePlaneIsNamed) {
  const Outcome tube = lapwing("parameterize tube.obj");
  EXPECT_EQ(tube.exit_code, 3);
  EXPECT_THAT(tube.output, AllOf(HasSubstr("--region: the region is not a disk: it has 2 boundary"),
                                 HasSubstr("{\"disk_in\": REGION}")));
  EXPECT_EQ(lapwing("parameterize tube.obj --region '{\"disk_in\": {\"all\": true}}'").exit_code,
            0);
  const Outcome pin = lapwing("parameterize tube.obj --region disk:120,0.6 --pin 0");
  EXPECT_EQ(pin.exit_code, 3);
  EXPECT_THAT(pin.output, HasSubstr("vertex 0 is not in the patch"));
  EXPECT_THAT(lapwing("parameterize tube.obj --region disk:120,0.6 --pin 120").output,
              HasSubstr("vertex 120 cannot be pinned"));
}

TEST_F(CommandLine, RemeshMakesTrianglesOfOneSizeWhereItIsAsked) {
  const Outcome outcome =
      lapwing("remesh tube.obj --region box:-1,-1,-1,1,1,1.5 --length 0.1 -o fine.obj");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("faces"), HasSubstr("mean edge"),
                                    HasSubstr("smallest angle"), HasSubstr("remesh")));
  const Mesh tube = read_mesh(file("tube.obj"));
  const Mesh fine = read_mesh(file("fine.obj"));
  EXPECT_GT(fine.face_count(), 2 * tube.face_count());
  for (std::size_t v = 0; v < tube.vertex_count(); ++v) {
    if (tube.positions[v].z() < 1.5) continue;
    EXPECT_THAT(fine.positions, ::testing::Contains(tube.positions[v])) << "above the box";
  }
  ASSERT_EQ(lapwing("remesh tube.obj --scale 2 --iterations 3 --quiet -o coarse.ply").exit_code, 0);
  EXPECT_LT(read_mesh(file("coarse.ply")).face_count(), tube.face_count());
}

TEST_F(CommandLine, RemeshRefusesWhatItCannotDo) {
  EXPECT_EQ(lapwing("remesh tube.obj").exit_code, 2);
  EXPECT_EQ(lapwing("remesh tube.obj --length 0 -o a.obj").exit_code, 2);
  EXPECT_EQ(lapwing("remesh tube.obj --length 1 --scale 2 -o a.obj").exit_code, 2);
  const Outcome region = lapwing("remesh tube.obj --region 999999 -o a.obj");
  EXPECT_EQ(region.exit_code, 3);
  EXPECT_THAT(region.output, HasSubstr("999999"));
  EXPECT_EQ(lapwing("remesh tube.obj --length 1e-12 -o a.obj").exit_code, 3);
  const Outcome nothing = lapwing("remesh tube.obj --region 3,7 -o a.obj");
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_THAT(nothing.output, HasSubstr("nothing was remeshed"));
}

TEST_F(CommandLine, CheckFindsAndFixes) {
  write("loose.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\nf 1 2 3\n");
  const Outcome found = lapwing("check loose.obj");
  EXPECT_EQ(found.exit_code, 0);
  EXPECT_THAT(found.output, AllOf(HasSubstr("loose"), HasSubstr("repeat")));
  ASSERT_EQ(lapwing("check loose.obj --fix fixed.obj").exit_code, 0);
  const Mesh fixed = read_mesh(file("fixed.obj"));
  EXPECT_EQ(fixed.vertex_count(), 3U);
  EXPECT_EQ(fixed.face_count(), 1U);
}

TEST_F(CommandLine, InfoListsTheCpuAndTheMesh) {
  const Outcome outcome = lapwing("info tube.obj");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("cpu"), HasSubstr("240")));
}

}  // namespace
}  // namespace lapwing
