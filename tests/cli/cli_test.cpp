// Runs the program as a user does and checks its exit code, output and files.
#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "support/gpu.h"
#include "support/split_meshes.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CommandLine, DeformByFlagsWritesMeshReportAndRecipeThatRunsToTheSameMesh) {
  succeed(kLiftFlags + "--device cpu --save a.obj --report a.json --recipe a.recipe.json");
  EXPECT_THAT(read("a.json"), AllOf(HasSubstr("\"certificate\""), HasSubstr("\"laplacian\"")));
  expect_recipe_repeats("a.recipe.json", "a.obj");
}

TEST_F(CommandLine, LargeTurnIsMadeInPartsByItselfOrAsAsked) {
  const std::string turn = kLiftFlags + "--rotate 0,0,1,260 --device cpu --save a.obj ";
  const std::string by_itself = succeed(turn);
  EXPECT_THAT(by_itself, HasSubstr("3 commits"));
  EXPECT_THAT(by_itself, Not(HasSubstr("--commit-every")));
  EXPECT_THAT(succeed(turn + "--commit-every 130 --recipe a.recipe.json"), HasSubstr("2 commits"));
  EXPECT_THAT(read("a.recipe.json"), HasSubstr("\"commit_every\": 130"));
  expect_refused(turn + "--commit-every 200", 2);
}

TEST_F(CommandLine, StrictTellsTheShellOfAResultWithWarningsAndWritesItAllTheSame) {
  succeed(kLiftFlags + "--device cpu --strict --save a.obj");
  const std::string cut_short = kLiftFlags +
                                "--rotate 1,0,0,80 --max-iterations 1 --device cpu --save b.obj "
                                "--report b.json ";
  EXPECT_THAT(succeed(cut_short), HasSubstr("not settled after 1 iteration: "));
  EXPECT_THAT(read("b.json"), HasSubstr("not settled after 1 iteration: "));
  const std::string written = read("b.obj");
  const Outcome strict = lapwing(cut_short + "--strict");
  EXPECT_EQ(strict.exit_code, 4) << strict.output;
  EXPECT_EQ(read("b.obj"), written);
  const Outcome quiet = lapwing(cut_short + "--strict --quiet");
  EXPECT_EQ(quiet.exit_code, 4);
  EXPECT_THAT(quiet.output, AllOf(HasSubstr("lapwing: warning: step 1: not settled after 1"),
                                  HasSubstr("lapwing: --strict: "), Not(HasSubstr("wrote"))));
  EXPECT_EQ(succeed(cut_short + "--quiet"), "");
}

TEST_F(CommandLine, ReportHoldsEveryVertexWhenAsked) {
  const std::string report = kLiftFlags + "--device cpu --report a.json ";
  succeed(report);
  EXPECT_THAT(read("a.json"), Not(HasSubstr("\"rotation_degrees\"")));
  succeed(report + "--report-vertices");
  EXPECT_THAT(read("a.json"), AllOf(HasSubstr("\"rotation_degrees\""),
                                    HasSubstr("\"displacement\""), HasSubstr("\"rotation\"")));
  expect_refused(kLiftFlags + "--save a.obj --report-vertices", 2);
}

TEST_F(CommandLine, VertexMotionIsSavedAsPropertiesOfAPlyAlone) {
  const std::string lift = kLiftFlags + "--device cpu --vertex-motion ";
  succeed(lift + "--save a.ply");
  EXPECT_THAT(read("a.ply"), HasSubstr("property double qw\nproperty double qx"));
  expect_refused(lift + "--save a.obj", 2, {"a.obj cannot store it; use --save with a .ply file"});
  expect_refused(lift + "--report a.json", 2, {"nothing is saved"});
}

TEST_F(CommandLine, WithoutTheLoaderTheCpuComputesAndANoteSaysSo) {
  const std::string no_loader = "LAPWING_VULKAN_LOADER=/nonexistent/libvulkan.so";
  const std::string said = succeed(kLiftFlags + "--save a.obj", no_loader);
  EXPECT_THAT(said, ::testing::StartsWith("lapwing: note: The CPU computes, because Vulkan finds "
                                          "no device. `lapwing info` says why.\n"));
  EXPECT_THAT(said, HasSubstr("device: CPU (cpu)"));
  EXPECT_THAT(succeed("info", no_loader), HasSubstr("mesa-vulkan-drivers"));
  const std::string asked = succeed(kLiftFlags + "--device cpu --save b.obj", no_loader);
  EXPECT_THAT(asked, Not(HasSubstr("The CPU computes")));
  EXPECT_EQ(read("a.obj"), read("b.obj"));
  const Outcome named = lapwing(kLiftFlags + "--device 0 --save c.obj", no_loader);
  EXPECT_EQ(named.exit_code, 5);
  EXPECT_THAT(named.output, AllOf(HasSubstr("mesa-vulkan-drivers"), HasSubstr("--device cpu")));
  EXPECT_FALSE(std::filesystem::exists(file("c.obj")));
}

TEST_F(CommandLine, AutoTakesTheCpuRatherThanASoftwareDeviceWhichStillDraws) {
  LAPWING_NEEDS_GPU();
  for (const auto& device : gpu::list_devices()) {
    if (device.type != "software") GTEST_SKIP() << "there is " << device.name;
  }
  const std::string said =
      succeed(kLiftFlags + "--save a.obj --render a.png --size 64x48 --report a.json");
  EXPECT_THAT(said, AllOf(HasSubstr("the only Vulkan device is a software one ("),
                          HasSubstr("`--device 0` uses it"), HasSubstr("device: CPU (cpu)")));
  EXPECT_THAT(read("a.png"), ::testing::StartsWith("\x89PNG"));
  EXPECT_EQ(nlohmann::json::parse(read("a.json"))["device"]["type"], "cpu");
  EXPECT_THAT(succeed(kLiftFlags + "--save b.obj --device 0"),
              AllOf(HasSubstr("(software)"), HasSubstr("settling runs on the CPU"),
                    Not(HasSubstr("The CPU computes"))));
  EXPECT_EQ(succeed(kLiftFlags + "--save b.obj --quiet"), "");
}

TEST_F(CommandLine, SummaryListsWhereEachKernelRan) {
  const std::string on_cpu = succeed(kLiftFlags + "--device cpu --save a.obj");
  EXPECT_THAT(on_cpu, ::testing::ContainsRegex("assemble_tangent +[0-9.]+ ms in 1 call on CPU\n"));
  LAPWING_NEEDS_GPU();
  const std::string name = gpu::list_devices().front().name;
  const std::string on_device = succeed(kLiftFlags + "--device 0 --frames device --save a.obj");
  for (const char* kernel : {"assemble_tangent", "fit_rotations", "energy_gradient"}) {
    const std::size_t line = on_device.find(kernel);
    ASSERT_NE(line, std::string::npos) << on_device;
    const std::string text = on_device.substr(line, on_device.find('\n', line) - line);
    EXPECT_THAT(text, ::testing::EndsWith(" on " + name)) << kernel;
  }
}

TEST_F(CommandLine, DeviceThatDoesNotExistIsRefusedWithTheOnesThatDo) {
  LAPWING_NEEDS_GPU();
  expect_refused(kLiftFlags + "--save a.obj --device nosuchdevice", 5, {"nosuchdevice"});
}

TEST_F(CommandLine, WrongArgumentsAreUsageErrors) {
  expect_refused("", 2);
  expect_refused("fly tube.obj", 2);
  expect_refused("deform tube.obj --save a.obj", 2, {"--targets"});
  expect_refused("deform tube.obj --handle disk:3 --save a.obj --device cpu", 2,
                 {"--handle", "disk:VERTEX,RADIUS"});
  expect_refused(kLiftFlags + "--render a.png --size 12by3", 2);
}

TEST_F(CommandLine, HelpAndVersionSucceed) {
  succeed("--help");
  succeed("--version");
  EXPECT_THAT(succeed("deform --help"), HasSubstr("--handle"));
}

TEST_F(CommandLine, EveryKeyOfADeformIsAFlag) {
  succeed(kLiftFlags +
          "--weights uniform --detail-length 0.2 --response rsi "
          "--constraint-weight 2 --hard --tolerance 0.001 "
          "--max-iterations 50 --commit-every 90 --recipe a.recipe.json "
          "--device cpu --save a.obj");
  for (const char* key :
       {"\"weights\": \"uniform\"", "\"detail_length\": 0.2", "\"response\": \"rsi\"",
        "\"constraint_weight\": 2", "\"hard\": true", "\"tolerance\": 0.001",
        "\"max_iterations\": 50", "\"commit_every\": 90"}) {
    EXPECT_THAT(read("a.recipe.json"), HasSubstr(key));
  }
}

TEST_F(CommandLine, ASoupIsEditedAndMeasuredAsTheSurfaceThatItIs) {
  const test::SplitMesh soup = test::soup(read_mesh(file("tube.obj")));
  write_mesh(soup.mesh, file("soup.obj"));
  // Returns the deformed positions and the largest detail error in the report.
  const auto bent = [&](const std::string& name) {
    const std::string said =
        succeed("deform " + name +
                ".obj --belt box:-1,-1,-1,1,1,0.4 --handle box:-1,-1,2.6,1,1,9 "
                "--translate=0.4,0,-0.2 --device cpu --strict --save bent.obj --report-vertices "
                "--report r.json");
    EXPECT_EQ(said.find("seam edges of the ROI are joined") != std::string::npos, name == "soup");
    const auto report = nlohmann::json::parse(read("r.json"));
    const auto& errors = report["steps"][0]["vertices"]["detail_error"];
    return std::pair(read_mesh(file("bent.obj")).positions,
                     std::ranges::max(errors.get<std::vector<double>>()));
  };
  const auto [whole, error] = bent("tube");
  const auto [parts, soup_error] = bent("soup");
  for (std::size_t v = 0; v < parts.size(); ++v) {
    EXPECT_LT((parts[v] - whole[soup.sources[v]]).norm(), 1e-6) << v;
  }
  EXPECT_GT(error, 0.01);
  EXPECT_NEAR(soup_error, error, 1e-9);
}

TEST_F(CommandLine, FlagOutOfItsRangeIsAUsageErrorThatSaysTheRange) {
  expect_refused(kLiftFlags + "--detail-length 0 --save a.obj", 2,
                 {"--detail-length", "a number from 0.000001 to 1000"});
  expect_refused(kLiftFlags + "--max-iterations 1.5 --save a.obj", 2,
                 {"a whole number from 1 to 1000000, got 1.5"});
  expect_refused(kLiftFlags + "--no-settle --tolerance 0.1 --save a.obj", 2);
}

TEST_F(CommandLine, KeysTellsWhatAStepTakes) {
  EXPECT_THAT(succeed("keys"),
              AllOf(HasSubstr("deform: "), HasSubstr("transplant: "),
                    HasSubstr("| `settle.tolerance` | a number above 0 | 0.0001 |")));
  EXPECT_THAT(lapwing("keys coat").output, Not(HasSubstr("deform: ")));
  expect_refused("keys fly", 2);
}

TEST_F(CommandLine, BrokenFilesNameFileAndLine) {
  write("bad.obj", "v 0 0 0\nv 1 0 zero\n");
  const Outcome mesh = lapwing("check bad.obj");
  EXPECT_EQ(mesh.exit_code, 3);
  EXPECT_THAT(mesh.output, HasSubstr("bad.obj:2"));
  write("bad.json", "{\"lapwing\": 1,\n \"mesh\": }");
  expect_refused("run bad.json", 3, {"bad.json:2"});
  write("typo.json", R"({"lapwing": 1, "mesh": "tube.obj", "step": []})");
  EXPECT_THAT(lapwing("run typo.json").output, AllOf(HasSubstr("step"), HasSubstr("steps")));
}

TEST_F(CommandLine, FilesThatCannotBeReadOrWrittenAreFileErrors) {
  expect_refused("check nothing-here.obj", 6);
  expect_refused("convert tube.obj nowhere/tube.ply", 6);
}

TEST_F(CommandLine, ConvertSaysWhatItCannotCarry) {
  write("red.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 1/1 2/2 3/3\n");
  EXPECT_THAT(succeed("convert red.obj red.off"), HasSubstr("material"));
}

TEST_F(CommandLine, ShapesAreMadeAndSubdivided) {
  succeed("shape bar -o bar.obj");
  const Mesh bar = read_mesh(file("bar.obj"));
  succeed("subdivide bar.obj -o fine.obj");
  const Mesh fine = read_mesh(file("fine.obj"));
  EXPECT_EQ(fine.face_count(), 4 * bar.face_count());
  EXPECT_EQ(fine.positions[0], bar.positions[0]) << "a corner";
  succeed("subdivide bar.obj -o round.obj --smooth --times 2");
  const Mesh round = read_mesh(file("round.obj"));
  EXPECT_EQ(round.face_count(), 16 * bar.face_count());
  EXPECT_NE(round.positions[0], bar.positions[0]) << "a corner";
  expect_refused("shape teapot -o a.obj", 2, {"bumpy-plane"});
}

TEST_F(CommandLine, RegionIsLaidIntoThePlane) {
  const std::string lay = "parameterize tube.obj --region disk:120,0.6 ";
  EXPECT_THAT(succeed(lay + "-o flat.obj --picture flat.png --size 200"),
              AllOf(HasSubstr("flipped  0 triangles"), HasSubstr("pins")));
  const Mesh flat = read_mesh(file("flat.obj"));
  EXPECT_GT(flat.attributes().uvs.size(), 5U);
  EXPECT_THAT(read("flat.png"), ::testing::StartsWith("\x89PNG"));
  succeed(lay + "--domain square --picture square.png --size 200");
  EXPECT_NE(read("square.png"), read("flat.png"));
}

TEST_F(CommandLine, WhatCannotBeLaidIntoThePlaneIsNamed) {
  const Outcome tube = lapwing("parameterize tube.obj");
  EXPECT_EQ(tube.exit_code, 3);
  EXPECT_THAT(tube.output, AllOf(HasSubstr("--region: the region is not a disk: it has 2 boundary"),
                                 HasSubstr("{\"disk_in\": REGION}")));
  succeed("parameterize tube.obj --region '{\"disk_in\": {\"all\": true}}'");
  const Outcome pin = lapwing("parameterize tube.obj --region disk:120,0.6 --pin 0");
  EXPECT_EQ(pin.exit_code, 3);
  EXPECT_THAT(pin.output, HasSubstr("vertex 0 is not in the patch"));
  EXPECT_THAT(lapwing("parameterize tube.obj --region disk:120,0.6 --pin 120").output,
              HasSubstr("vertex 120 cannot be pinned"));
}

TEST_F(CommandLine, RemeshMakesTrianglesOfOneSizeWhereItIsAsked) {
  EXPECT_THAT(succeed("remesh tube.obj --region box:-1,-1,-1,1,1,1.5 --length 0.1 -o fine.obj"),
              AllOf(HasSubstr("faces"), HasSubstr("mean edge"), HasSubstr("smallest angle")));
  const Mesh tube = read_mesh(file("tube.obj"));
  const Mesh fine = read_mesh(file("fine.obj"));
  EXPECT_GT(fine.face_count(), 2 * tube.face_count());
  for (std::size_t v = 0; v < tube.vertex_count(); ++v) {
    if (tube.positions[v].z() < 1.5) continue;
    EXPECT_THAT(fine.positions, ::testing::Contains(tube.positions[v])) << "above the box";
  }
  succeed("remesh tube.obj --scale 2 --iterations 3 --quiet -o coarse.ply");
  write("m.mtl", "newmtl red\nKd 1 0 0\n");
  write("m.obj", "mtllib m.mtl\nusemtl red\n" + read("tube.obj"));
  EXPECT_THAT(succeed("remesh m.obj --scale 2 -o m.glb"), Not(HasSubstr("not carried over")));
  EXPECT_THAT(read("m.glb"), HasSubstr(R"("baseColorFactor":[1,0,0,1])"));
  EXPECT_LT(read_mesh(file("coarse.ply")).face_count(), tube.face_count());
}

TEST_F(CommandLine, RemeshRefusesWhatItCannotDo) {
  expect_refused("remesh tube.obj", 2);
  expect_refused("remesh tube.obj --length 0 -o a.obj", 2);
  expect_refused("remesh tube.obj --length 1 --scale 2 -o a.obj", 2);
  const Outcome region = lapwing("remesh tube.obj --region 999999 -o a.obj");
  EXPECT_EQ(region.exit_code, 3);
  EXPECT_THAT(region.output, HasSubstr("999999"));
  expect_refused("remesh tube.obj --length 1e-12 -o a.obj", 3);
  EXPECT_THAT(succeed("remesh tube.obj --region 3,7 -o a.obj"), HasSubstr("nothing was remeshed"));
}

TEST_F(CommandLine, CheckFindsAndFixes) {
  write("loose.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\nf 1 2 3\n");
  EXPECT_THAT(succeed("check loose.obj"), AllOf(HasSubstr("loose"), HasSubstr("repeat")));
  succeed("check loose.obj --fix fixed.obj");
  const Mesh fixed = read_mesh(file("fixed.obj"));
  EXPECT_EQ(fixed.vertex_count(), 3U);
  EXPECT_EQ(fixed.face_count(), 1U);
}

TEST_F(CommandLine, CheckFillsHoles) {
  EXPECT_THAT(succeed("check tube.obj"), HasSubstr("2 holes"));
  EXPECT_THAT(succeed("check tube.obj --fix flat.obj --fill-holes flat"),
              AllOf(HasSubstr("2 holes filled with "), HasSubstr(" and 0 new vertices")));
  EXPECT_EQ(read_mesh(file("flat.obj")).vertex_count(), 240U);
  EXPECT_THAT(succeed("check tube.obj --fix round.obj --fill-holes smooth"),
              HasSubstr("boundary      none"));
  EXPECT_GT(read_mesh(file("round.obj")).vertex_count(), 240U);
  EXPECT_THAT(succeed("check tube.obj --fix open.obj --fill-holes flat --largest 3"),
              HasSubstr("no hole to fill"));
  expect_refused("check tube.obj --fill-holes flat", 2);
  expect_refused("check tube.obj --fix a.obj --fill-holes round", 2);
}

TEST_F(CommandLine, APartThatIsInsideOutIsTurnedWhenItIsFilled) {
  // A tetrahedron without its lower face, whose normals point inward.
  write("turned.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 3\n3 1 0 3\n3 2 1 3\n3 0 2 3\n");
  EXPECT_THAT(succeed("check turned.off --fix a.off --fill-holes flat"),
              AllOf(HasSubstr("1 hole filled"), HasSubstr("1 inside-out part turned")));
}

TEST_F(CommandLine, TheBorderOfASheetIsFilledOnRequest) {
  succeed("shape sheet -o sheet.obj");
  EXPECT_THAT(succeed("check sheet.obj --fix a.obj --fill-holes flat"),
              HasSubstr("no hole to fill"));
  EXPECT_THAT(succeed("check sheet.obj --fix a.obj --fill-holes flat --fill-borders"),
              HasSubstr("1 hole filled"));
}

TEST_F(CommandLine, CheckReadsPastWhatOtherCommandsRefuse) {
  write("short.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\nf 1 2\nf 1 2 9\n");
  expect_refused("convert short.obj a.off", 3, {"short.obj:7", "`lapwing check MESH --fix OUT`"});
  expect_refused("check short.obj", 3,
                 {"1 face with fewer than three corners\n         line 7: ",
                  "1 face that names a missing vertex\n         line 8: ", "--fix OUT"});
  EXPECT_THAT(succeed("check short.obj --fix whole.obj"),
              HasSubstr("Repairs\n1 face with fewer than three corners left out\n"
                        "1 face that named a missing vertex left out\n\nAfter"));
  EXPECT_EQ(read_mesh(file("whole.obj")).face_count(), 2U);
}

TEST_F(CommandLine, RepairedFilesKeepTheirEncoding) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\n";
  write("open.stl", "solid a\n" + facet);
  succeed("check open.stl --fix closed.stl");
  EXPECT_THAT(read("closed.stl"),
              AllOf(::testing::StartsWith("solid a\n"), ::testing::EndsWith("endsolid a\n")));
}

TEST_F(CommandLine, InfoListsTheCpuAndTheMesh) {
  EXPECT_THAT(succeed("info tube.obj"), AllOf(HasSubstr("cpu"), HasSubstr("240")));
}

}  // namespace
}  // namespace lapwing
