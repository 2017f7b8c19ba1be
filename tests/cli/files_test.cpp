// Tests untrusted input files and output files that cannot be written.
#include <sys/stat.h>

#include "batch/bent_tubes.h"
#include "command_line.h"
#include "lapwing/io/mesh_file.h"
#include "support/largest_distance.h"
#include "support/sanitizers.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kBend =
    " --roi all --belt box:-1,-1,-1,1,1,0.4 --handle box:-1,-1,2.8,1,1,4 --translate 0.3,0,0 "
    "--device cpu --quiet ";

class FilesOfTheCommandLine : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    write("bend.json", test::kBendTube);
  }
};

TEST_F(FilesOfTheCommandLine, NoOutputGoesOverAnother) {
  fs::create_directory(file("sub"));
  for (const std::string flags :
       {"--report a.ply", "--report ./sub/../a.ply", "--render a.png --render-before a.png",
        "--render r.png --render-before ./r.png"}) {
    expect_refused("run bend.json --device cpu --save a.ply " + flags, 2, {"name another file"});
  }
  expect_refused("deform tube.obj" + kBend + "--report r.json --recipe r.json", 2,
                 {"r.json is also written as --report"});
  expect_refused("cut tube.obj --region box:-1,-1,1,1,1,4 -o x.obj --rest x.obj", 2,
                 {"x.obj is also written as --output"});
  expect_refused("parameterize tube.obj --region disk:120,0.6 -o a.obj --picture a.obj", 2,
                 {"end its name in .png"});
}

TEST_F(FilesOfTheCommandLine, NoOutputGoesOverAnInput) {
  fs::create_symlink("bend.json", file("link.json"));
  const std::string report = "run bend.json --device cpu --report ";
  expect_refused(report + "bend.json", 2, {"read as the recipe"});
  expect_refused(report + "link.json", 2, {"read as the recipe"});
  expect_refused(report + "tube.obj", 2, {"read as the mesh"});
  expect_refused("deform tube.obj" + kBend + "--recipe tube.obj", 2, {"read as the mesh"});
  expect_refused("render tube.obj -o tube.obj", 2, {"end its name in .png"});
  write_mesh(grid(8, 8), file("sheet.ply"));
  expect_refused(
      "coat tube.obj --source sheet.ply --source-patch disk:40,3 --target-patch disk:120,0.6 "
      "--detail-size 0.2 --device cpu --save sheet.ply",
      2, {"read as a source"});
}

TEST_F(FilesOfTheCommandLine, AMeshMayBeReplacedByItsEdit) {
  const std::string before = read("tube.obj");
  succeed("deform tube.obj" + kBend + "--save tube.obj");
  EXPECT_NE(read("tube.obj"), before);
}

// The input mesh does not exist. A command that began its work would report this mesh instead.
TEST_F(FilesOfTheCommandLine, PlacesThatTakeNoFileAreToldBeforeTheWork) {
  fs::create_directory(file("folder.ply"));
  fs::create_directory(file("folder.png"));
  write("none.json", R"({"lapwing": 1, "mesh": "none.obj", "steps": []})");
  for (const std::string command :
       {"run none.json --device cpu --save ", "convert none.obj ", "subdivide none.obj -o ",
        "peel none.obj --detail-size 1 -o ", "remesh none.obj -o ", "check none.obj --fix ",
        "cut none.obj --region 1 -o "}) {
    expect_refused(command + "folder.ply", 6, {"folder.ply: Is a directory"});
    expect_refused(command + "nowhere/a.ply", 6, {"nowhere/a.ply: No such file or directory"});
  }
  expect_refused("run none.json --device cpu --report nowhere/r.json", 6, {"nowhere/r.json"});
  expect_refused("run none.json --device cpu --render folder.png", 6, {"Is a directory"});
  expect_refused("render none.obj -o nowhere/a.png", 6, {"nowhere/a.png"});
}

// An earlier version replaced the mesh although it could not write the report.
TEST_F(FilesOfTheCommandLine, OfOneRunAreAllPutInPlaceOrNone) {
  write("out.obj", "old");
  const Outcome outcome =
      lapwing("--version >/dev/null; ulimit -f 24; '" + std::string(LAPWING_CLI) +
              "' run bend.json --device cpu --save out.obj --report r.json --report-vertices");
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_EQ(read("out.obj"), "old");
  EXPECT_FALSE(fs::exists(file("r.json")));
}

TEST_F(FilesOfTheCommandLine, PipesAreRefusedAtOnce) {
  for (const char* const name : {"pipe.obj", "pipe.json", "parts/pipe.json", "pipe.png"}) {
    fs::create_directories(file(name).parent_path());
    ASSERT_EQ(::mkfifo(file(name).c_str(), 0600), 0);
  }
  write_mesh(grid(4, 4), file("parts/pipe.obj"));
  EXPECT_EQ(lapwing("check pipe.obj").exit_code, 6);
  EXPECT_EQ(lapwing("run pipe.json").exit_code, 6);
  EXPECT_THAT(lapwing("parts list parts --no-pictures").output,
              HasSubstr("pipe.json: not a regular file"));
  EXPECT_THAT(lapwing("render tube.obj -o pipe.png").output, HasSubstr("not a regular file"));
}

TEST_F(FilesOfTheCommandLine, NamesThatAreNotUtf8) {
  const std::string name = "m\xF6we.obj";
  fs::copy_file(file("tube.obj"), file(name));
  succeed("deform " + name + kBend + "--save \xFC.obj --report r.json");
  EXPECT_NE(read("\xFC.obj"), "");
  EXPECT_THAT(read("r.json"), HasSubstr("m\uFFFDwe.obj"));
  expect_refused("deform " + name + kBend + "--save a.obj --recipe a.json", 3,
                 {"is not UTF-8, but a recipe must be"});
  EXPECT_FALSE(fs::exists(file("a.obj"))) << "told before the work";
  EXPECT_THAT(lapwing("check none-\xE4.obj").output, HasSubstr("none-\\xE4.obj"));
  succeed("coat tube.obj --source " + name +
          " --source-patch disk:120,0.6 --target-patch disk:120,0.6 "
          "--detail-size 0.2 --device cpu --save \xFC.obj --quiet");
}

TEST_F(FilesOfTheCommandLine, ContentsThatAreNotUtf8) {
  write("latin.obj", "mtllib m\xF6we.mtl\n" + read("tube.obj"));
  succeed("deform latin.obj" + kBend + "--save out.ply --report r.json");
  EXPECT_THAT(read("r.json"), HasSubstr("\"certificate\""));
}

// Some editors, such as Notepad, and PowerShell begin a file with a byte-order mark.
TEST_F(FilesOfTheCommandLine, AByteOrderMarkBeforeARecipeOrAJobIsSkipped) {
  const std::string mark = "\xEF\xBB\xBF";
  succeed("run bend.json --save a.obj --device cpu --quiet");
  write("marked.json", mark + read("bend.json"));
  succeed("run marked.json --save b.obj --device cpu --quiet");
  EXPECT_EQ(read("b.obj"), read("a.obj"));
  write("jobs.jsonl", mark + R"({"id": "a", "recipe": "marked.json"})" + "\n" + mark +
                          R"({"id": "b", "recipe": "marked.json"})" + "\n");
  succeed("batch jobs.jsonl -o out --format obj --quiet");
  EXPECT_EQ(read("out/a.obj"), read("a.obj"));
  EXPECT_EQ(read("out/b.obj"), read("a.obj")) << "as after `cat a.jsonl b.jsonl`";
}

TEST_F(FilesOfTheCommandLine, AByteOrderMarkBeforeAGltfFileIsKept) {
  succeed("convert tube.obj tube.gltf");
  write("marked.gltf", "\xEF\xBB\xBF" + read("tube.gltf"));
  succeed("deform marked.gltf" + kBend + "--save out.gltf");
  EXPECT_EQ(read("out.gltf").substr(0, 4), "\xEF\xBB\xBF{");
  succeed("deform tube.gltf" + kBend + "--save plain.gltf");
  EXPECT_EQ(read_mesh(file("out.gltf")).positions, read_mesh(file("plain.gltf")).positions);
}

TEST_F(FilesOfTheCommandLine, PointCloudsAreRefusedByEditsAndNamedByTheOthers) {
  write("points.ply",
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0.2\n");
  const std::string why =
      ": the mesh has no surface to edit: it has 4 vertices and no faces; export it with its "
      "faces, or reconstruct the surface of the points first";
  const std::string coat = " --target-patch disk:0,1 --detail-size 1 --device cpu --save o.ply";
  for (const std::string& command : std::vector<std::string>{
           "deform points.ply --handle 3 --translate 0,0,1 --device cpu --save o.ply",
           "coat points.ply --source tube.obj --source-patch disk:120,0.6" + coat,
           "coat tube.obj --source points.ply" + coat,
           "transplant points.ply --part tube.obj --target-region 0,1 --device cpu --save o.ply",
           "transplant tube.obj --part points.ply --target-region disk:120,0.6 --device cpu --save "
           "o.ply",
           "peel points.ply --detail-size 1 -o o.ply", "remesh points.ply -o o.ply",
           "cut points.ply --region 0,1,2 -o o.ply", "parameterize points.ply -o o.ply"}) {
    expect_refused(command, 3, {why});
  }
  EXPECT_THAT(lapwing("check points.ply").output, HasSubstr("no usable face"));
  const std::string warning = "warning: points.ply has no surface: it has 4 vertices and no faces";
  for (const char* const command : {"render points.ply -o a.png --size 64x48",
                                    "convert points.ply a.obj", "subdivide points.ply -o a.ply"}) {
    EXPECT_THAT(succeed(command), HasSubstr(warning)) << command;
  }
}

TEST_F(FilesOfTheCommandLine, ObjectsThatAreNotReadAreNoted) {
  succeed("convert tube.obj tube.gltf");
  std::string text = read("tube.gltf");
  const std::string nodes = R"("nodes":[{"mesh":0,)";
  ASSERT_NE(text.find(nodes), std::string::npos);
  text.insert(text.find(nodes) + nodes.size() - 10,
              R"({"mesh":0,"name":"hidden","scale":[0,0,0]},)");
  text.replace(text.find(R"("nodes":[0])"), 11, R"("nodes":[0,1])");
  write("two.gltf", text);
  for (const char* const command :
       {"check two.gltf", "info two.gltf", "convert two.gltf a.obj", "render two.gltf -o a.png",
        "peel two.gltf --detail-size 1 -o a.ply",
        "deform two.gltf --roi all --belt 0 --handle near:0,0,6,1 --translate 0.5,0,0 --device cpu "
        "--save b.gltf"}) {
    EXPECT_THAT(succeed(command),
                AllOf(HasSubstr("note: "), HasSubstr("two.gltf: 'hidden' has a scale of 0")))
        << command;
  }
  EXPECT_THAT(read("b.gltf"), HasSubstr(R"("name":"hidden","scale":[0,0,0])"));
}

TEST_F(FilesOfTheCommandLine, TriangleStripsAreEditedAsStrips) {
  const std::string strips =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0.2\n5 0 1 2 3 -1\n";
  write("strip.ply", strips);
  succeed(
      "deform strip.ply --roi all --belt 0,1,2 --handle 3 --translate 0,0,1 --hard --device "
      "cpu --save o.ply");
  EXPECT_EQ(read("o.ply"), std::string(strips).replace(strips.find("1 1 0.2"), 7, "1 1 1.2"));
  succeed("convert strip.ply o.off");
  EXPECT_EQ(read_mesh(file("o.off")).face_vertices(), (std::vector<Index>{0, 1, 2, 1, 3, 2}));
}

// Escape sequences could control the terminal, and line breaks could imitate the program's
// messages.
TEST_F(FilesOfTheCommandLine, NothingThatOthersWroteReachesTheTerminalAsItIs) {
  const std::string escape = "\x1B]0;owned\x07";
  write("a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement " +
            escape + " 1\nproperty float " + escape +
            "\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
            "0 0 0\n1 0 0\n0 1 0\n5\n3 0 1 2\n");
  write("b.obj", "mtllib " + escape + ".mtl\nusemtl " + escape + "\n" + read("tube.obj"));
  write("c.json",
        R"({"lapwing": 1, "mesh": "tube.obj", "steps": [], "\u001b[31m\nlapwing: fine": 1})");
  write("d.json",
        R"({"lapwing": 1, "mesh": ")" + std::string("\\u001b[31m") + R"(.obj", "steps": []})");
  fs::copy_file(file("tube.obj"), file("x" + escape + "\nlapwing: fine.obj"));
  for (const std::string& arguments : std::vector<std::string>{
           "convert a.ply a.off", "convert b.obj sub.obj", "check b.obj", "run c.json",
           "run d.json", "check 'x" + escape + "\nlapwing: fine.obj'",
           "convert tube.obj 'none" + escape + "/a.obj'",
           "info 'x" + escape + "\nlapwing: fine.obj'", "check 'y" + escape + "'",
           "'--no-such-flag=" + escape + "' check", "parts list . --no-pictures",
           "cut tube.obj --region box:-1,-1,1,1,1,4 -o 'z" + escape + ".obj'"}) {
    const Outcome outcome = lapwing(arguments);
    EXPECT_THAT(outcome.output, Not(AnyOf(HasSubstr("\x1B"), HasSubstr("\x07")))) << arguments;
    EXPECT_THAT(outcome.output, Not(HasSubstr("\nlapwing: fine"))) << arguments;
    EXPECT_NE(outcome.output, "") << arguments;
  }
}

TEST_F(FilesOfTheCommandLine, StandardOutputThatTakesNothingIsAFailure) {
  for (const std::string arguments : {"info", "--help", "check tube.obj"}) {
    const Outcome outcome = lapwing(arguments + " 2>&1 >/dev/full || echo exit $?");
    EXPECT_THAT(outcome.output,
                AllOf(HasSubstr("cannot write to standard output: No space"), HasSubstr("exit 6")))
        << arguments;
  }
}

TEST_F(FilesOfTheCommandLine, ARecipeIsKeptInItsFolder) {
  fs::create_directory(file("box"));
  fs::copy_file(file("tube.obj"), file("box/tube.obj"));
  const auto recipe = [&](const std::string& mesh, const std::string& save) {
    write("box/r.json",
          R"({"lapwing": 1, "mesh": ")" + mesh + R"(", "steps": [], "save": ")" + save + R"("})");
  };
  recipe("tube.obj", "out.obj");
  succeed("run box/r.json --device cpu --sandbox box");
  recipe("../tube.obj", "out.obj");
  expect_refused("run box/r.json --device cpu --sandbox box", 3, {"reads box/../tube.obj"});
  recipe("tube.obj", "../out.obj");
  expect_refused("run box/r.json --device cpu --sandbox box", 3, {"writes box/../out.obj"});
  recipe("tube.obj", "../out.obj");
  EXPECT_EQ(lapwing("run box/r.json --device cpu").exit_code, 0) << "without a sandbox it may";
}

TEST_F(FilesOfTheCommandLine, JobsOfABatchAreKeptInTheirFolder) {
  fs::create_directory(file("box"));
  fs::copy_file(file("tube.obj"), file("box/tube.obj"));
  fs::copy_file(file("bend.json"), file("box/bend.json"));
  write("jobs.jsonl", R"({"id": "in", "recipe": "box/bend.json"}
{"id": "out", "recipe": "bend.json"}
{"id": "mesh", "recipe": "box/bend.json", "set": {"/mesh": "../tube.obj"}}
)");
  const Outcome outcome = lapwing("batch jobs.jsonl -o done --sandbox box");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  EXPECT_TRUE(fs::exists(file("done/in.ply")));
  EXPECT_THAT(read("done/failed.jsonl"),
              AllOf(HasSubstr("bend.json is outside box"), HasSubstr("reads box/../tube.obj")));
}

// An earlier version replaced any file that had the name of a part's image, even through a link.
TEST_F(FilesOfTheCommandLine, ListingPartsKeepsPicturesOfOthers) {
  fs::create_directory(file("shelf"));
  write_mesh(grid(4, 4), file("shelf/sheet.obj"));
  write_mesh(grid(4, 4), file("shelf/cloth.obj"));
  write("shelf/sheet.png", "a texture");
  write("precious.txt", "mine");
  fs::create_symlink("../precious.txt", file("shelf/cloth.png"));
  fs::last_write_time(file("shelf/sheet.png"),
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  const std::string outcome = succeed("parts list shelf");
  EXPECT_EQ(read("shelf/sheet.png"), "a texture");
  EXPECT_EQ(read("precious.txt"), "mine");
  EXPECT_THAT(outcome, HasSubstr("sheet.png was not made by Lapwing"));
}

// The memory limit decreases from run to run. Each run either succeeds or reports that memory ran
// out.
TEST_F(FilesOfTheCommandLine, OfARunWithoutMemoryAreWhole) {
#ifdef LAPWING_ADDRESS_SANITIZER
  GTEST_SKIP() << "AddressSanitizer takes terabytes of addresses";
#endif
  write_mesh(cylinder(48, 80, 0.5, 3.0), file("tube.obj"));
  const std::string whole = succeed("run bend.json --device cpu --quiet --save whole.obj");
  int refused = 0;
  for (int megabytes = 16; megabytes < 400; megabytes += megabytes / 8) {
    write("out.obj", "old");
    const Outcome outcome =
        lapwing("--version >/dev/null; ulimit -v " + std::to_string(megabytes * 1024) + "; '" +
                LAPWING_CLI + "' run bend.json --device cpu --quiet --save out.obj");
    if (outcome.exit_code == 127) continue;  // the system could not start the program
    EXPECT_THAT(outcome.exit_code, AnyOf(0, 4)) << megabytes << " MB: " << outcome.output;
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.output.find("memory") != std::string::npos)
        << outcome.output;
    // With little memory, settling starts from another surface, so the result is only equal within
    // the tolerance of settling.
    if (outcome.exit_code == 0) {
      const Positions saved = read_mesh(folder_ / "out.obj").positions;
      const Positions expected = read_mesh(folder_ / "whole.obj").positions;
      ASSERT_EQ(saved.size(), expected.size());
      EXPECT_LT(test::largest_distance(saved, expected), 1e-3);
    } else {
      EXPECT_EQ(read("out.obj"), "old");
    }
    refused += outcome.exit_code != 0 ? 1 : 0;
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace lapwing
