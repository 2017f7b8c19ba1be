// What the program reads and writes, where others made it or it cannot be had.
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  test::Files files() const { return test::files_in(folder_.path()); }

  // Ends so and says that, and changes no file.
  void expect_refused(const std::string& arguments, int code, const std::string& words) const {
    const test::Files before = files();
    const Outcome outcome = lapwing(arguments);
    EXPECT_EQ(outcome.exit_code, code) << arguments << "\n" << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(words)) << arguments;
    EXPECT_TRUE(files() == before) << arguments << " changed files";
  }
};

TEST_F(FilesOfTheCommandLine, NoOutputGoesOverAnother) {
  for (const std::string flags :
       {"--save a.ply --report a.ply", "--save a.ply --report ./sub/../a.ply",
        "--save a.ply --render a.png --render-before a.png",
        "--report r.json --report-vertices "
        "--save a.ply --render r.png --render-before ./r.png"}) {
    fs::create_directory(file("sub"));
    expect_refused("run bend.json --device cpu " + flags, 2, "name another file");
    fs::remove(file("sub"));
  }
  expect_refused("deform tube.obj" + kBend + "--report r.json --recipe r.json", 2,
                 "r.json is also written as --report");
  expect_refused("cut tube.obj --region box:-1,-1,1,1,1,4 -o x.obj --rest x.obj", 2,
                 "x.obj is also written as --output");
  expect_refused("parameterize tube.obj --region disk:120,0.6 -o a.obj --picture a.obj", 2,
                 "end its name in .png");
}

TEST_F(FilesOfTheCommandLine, NoOutputGoesOverAnInput) {
  fs::create_symlink("bend.json", file("link.json"));
  expect_refused("run bend.json --device cpu --report bend.json", 2, "read as the recipe");
  expect_refused("run bend.json --device cpu --report link.json", 2, "read as the recipe");
  expect_refused("run bend.json --device cpu --report tube.obj", 2, "read as the mesh");
  expect_refused("deform tube.obj" + kBend + "--recipe tube.obj", 2, "read as the mesh");
  expect_refused("render tube.obj -o tube.obj", 2, "end its name in .png");
  write_mesh(grid(8, 8), file("sheet.ply"));
  expect_refused(
      "coat tube.obj --source sheet.ply --source-patch disk:40,3 --target-patch disk:120,0.6 "
      "--detail-size 0.2 --device cpu --save sheet.ply",
      2, "read as a source");
}

TEST_F(FilesOfTheCommandLine, AMeshMayBeReplacedByItsEdit) {
  const std::string before = read("tube.obj");
  const Outcome outcome = lapwing("deform tube.obj" + kBend + "--save tube.obj");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(read("tube.obj"), before);
}

// The mesh is not there: whoever looks for it first has begun the work.
TEST_F(FilesOfTheCommandLine, PlacesThatTakeNoFileAreToldBeforeTheWork) {
  fs::create_directory(file("folder.ply"));
  fs::create_directory(file("folder.png"));
  for (const std::string command :
       {"run none.json --save ", "convert none.obj ", "subdivide none.obj -o ",
        "peel none.obj "
        "--detail-size 1 -o ",
        "remesh none.obj -o ", "check none.obj --fix ", "cut none.obj --region 1 -o "}) {
    if (!command.starts_with("run")) {
      expect_refused(command + "folder.ply", 6, "folder.ply: Is a directory");
      expect_refused(command + "nowhere/a.ply", 6, "nowhere/a.ply: No such file or directory");
    }
  }
  write("none.json", R"({"lapwing": 1, "mesh": "none.obj", "steps": []})");
  expect_refused("run none.json --device cpu --save folder.ply", 6, "Is a directory");
  expect_refused("run none.json --device cpu --report nowhere/r.json", 6, "nowhere/r.json");
  expect_refused("run none.json --device cpu --render folder.png", 6, "Is a directory");
  expect_refused("render none.obj -o nowhere/a.png", 6, "nowhere/a.png");
}

// The mesh was replaced, and the report that could not be written said that nothing was changed.
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
  const Outcome deformed = lapwing("deform " + name + kBend + "--save \xFC.obj --report r.json");
  EXPECT_EQ(deformed.exit_code, 0) << deformed.output;
  EXPECT_NE(read("\xFC.obj"), "");
  EXPECT_THAT(read("r.json"), HasSubstr("m\uFFFDwe.obj"));
  const Outcome recipe = lapwing("deform " + name + kBend + "--save a.obj --recipe a.json");
  EXPECT_EQ(recipe.exit_code, 3);
  EXPECT_THAT(recipe.output, HasSubstr("is not UTF-8, but a recipe must be"));
  EXPECT_FALSE(fs::exists(file("a.obj"))) << "told before the work";
  EXPECT_THAT(lapwing("check none-\xE4.obj").output, HasSubstr("none-\\xE4.obj"));
  const Outcome coat = lapwing("coat tube.obj --source " + name +
                               " --source-patch disk:120,0.6 --target-patch disk:120,0.6 "
                               "--detail-size 0.2 --device cpu --save \xFC.obj --quiet");
  EXPECT_EQ(coat.exit_code, 0) << coat.output;
}

TEST_F(FilesOfTheCommandLine, ContentsThatAreNotUtf8) {
  write("latin.obj", "mtllib m\xF6we.mtl\n" + read("tube.obj"));
  const Outcome outcome = lapwing("deform latin.obj" + kBend + "--save out.ply --report r.json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(read("r.json"), HasSubstr("\"certificate\""));
}

// Escapes could have the terminal do things, and ends of lines speak with the program's voice.
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
  EXPECT_EQ(lapwing("run box/r.json --device cpu --sandbox box").exit_code, 0);
  recipe("../tube.obj", "out.obj");
  expect_refused("run box/r.json --device cpu --sandbox box", 3, "reads box/../tube.obj");
  recipe("tube.obj", "../out.obj");
  expect_refused("run box/r.json --device cpu --sandbox box", 3, "writes box/../out.obj");
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

// A part's picture took the place of whatever was called so, also behind a link.
TEST_F(FilesOfTheCommandLine, ListingPartsKeepsPicturesOfOthers) {
  fs::create_directory(file("shelf"));
  write_mesh(grid(4, 4), file("shelf/sheet.obj"));
  write_mesh(grid(4, 4), file("shelf/cloth.obj"));
  write("shelf/sheet.png", "a texture");
  write("precious.txt", "mine");
  fs::create_symlink("../precious.txt", file("shelf/cloth.png"));
  fs::last_write_time(file("shelf/sheet.png"),
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  const Outcome outcome = lapwing("parts list shelf");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(read("shelf/sheet.png"), "a texture");
  EXPECT_EQ(read("precious.txt"), "mine");
  EXPECT_THAT(outcome.output, HasSubstr("sheet.png was not made by Lapwing"));
}

// Less and less memory: each run says so, or does its work.
TEST_F(FilesOfTheCommandLine, OfARunWithoutMemoryAreWhole) {
#ifdef LAPWING_ADDRESS_SANITIZER
  GTEST_SKIP() << "AddressSanitizer takes terabytes of addresses";
#endif
  write_mesh(cylinder(48, 80, 0.5, 3.0), file("tube.obj"));
  const Outcome whole = lapwing("run bend.json --device cpu --quiet --save whole.obj");
  ASSERT_EQ(whole.exit_code, 0) << whole.output;
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
    // With little memory settling begins elsewhere, and ends there within its tolerance.
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
