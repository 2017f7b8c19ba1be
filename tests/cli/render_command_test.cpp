// Tests the images that `lapwing render` and edits write, and turntables.
#include <set>

#include <nlohmann/json.hpp>

#include "cli/command_line.h"
#include "support/gpu.h"
#include "support/stand_in_ffmpeg.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;

// `sh interrupt FILE PROGRAM ...` runs the program. When FILE exists, the script sends the signal
// of Ctrl+C to the program.
const char* const kInterrupt = R"(awaited=$1
shift
"$@" &
while [ ! -e "$awaited" ] && kill -0 $!; do sleep 0.02; done
kill -INT $!
wait $!
)";

std::size_t files_called(const std::filesystem::path& folder, const std::string& part) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().find(part) != std::string::npos) ++count;
  }
  return count;
}

TEST_F(CommandLine, RenderDrawsAMeshAndHowItDiffersFromItsRestPose) {
  LAPWING_NEEDS_GPU();
  succeed(kLiftFlags + "--device cpu --save a.obj");
  const std::string render = "render a.obj -o a.png --size 160x120 ";
  succeed(render);
  std::set<std::string> pictures{read("a.png")};
  for (const std::string color : {"displacement", "rotation", "detail", "stretch"}) {
    succeed(render + "--rest tube.obj --color " + color);
    EXPECT_TRUE(pictures.insert(read("a.png")).second) << color << " looks like another one";
  }
  EXPECT_EQ(lapwing(render + "--color rotation").exit_code, 2) << "without --rest";
}

TEST_F(CommandLine, RenderDrawsMatcapsAndXrays) {
  LAPWING_NEEDS_GPU();
  std::set<std::string> pictures;
  for (const std::string style :
       {"", "--xray", "--wireframe", "--matcap clay", "--matcap metal", "--matcap pearl"}) {
    succeed("render tube.obj -o a.png --size 160x120 " + style);
    EXPECT_TRUE(pictures.insert(read("a.png")).second) << style << " looks like another style";
  }
  EXPECT_EQ(lapwing("render tube.obj -o a.png --matcap gold").exit_code, 2);
}

TEST_F(CommandLine, RenderShowsTheColorsOfTheFileAndSaysWhatIsMissing) {
  LAPWING_NEEDS_GPU();
  write("a.mtl", "newmtl skin\nKd 1 0 0\nmap_Kd gone.png\n");
  write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl skin\nf 1/1 2/1 3/1\n");
  const std::string render = "render a.obj -o a.png --size 160x120 ";
  const std::string red = succeed(render);
  EXPECT_EQ(red, "lapwing: note: image 'gone.png' is not beside a.mtl; put it there\n");
  const std::string picture = read("a.png");
  succeed(render + "--color file");
  EXPECT_EQ(read("a.png"), picture);
  EXPECT_EQ(lapwing(render + "--color plain").output, "");
  EXPECT_NE(read("a.png"), picture);
  EXPECT_EQ(lapwing(render + "--color file --rest a.obj").exit_code, 2) << "no difference";
}

TEST_F(CommandLine, PicturesAndSharesOfTheDiagonalLeaveOutIsolatedVertices) {
  LAPWING_NEEDS_GPU();
  const std::string tube = read("tube.obj");
  write("stray.obj", tube + "v 5000 5000 5000\n");
  for (const std::string options : {"", "--turntable 2 ", "--orthographic "}) {
    const std::string render = "render -o a.png --size 160x120 " + options;
    const std::string picture = options == "--turntable 2 " ? "a-0001.png" : "a.png";
    succeed(render + "tube.obj");
    const std::string wanted = read(picture);
    succeed(render + "stray.obj");
    EXPECT_TRUE(read(picture) == wanted) << options;
  }
  const auto diagonal = [&](const std::string& mesh) {
    succeed("deform " + mesh + kLiftFlags.substr(kLiftFlags.find(" --")) +
            "--device cpu --save b.obj --report report.json");
    return nlohmann::json::parse(read("report.json"))["mesh"]["diagonal"];
  };
  EXPECT_EQ(diagonal("stray.obj"), diagonal("tube.obj"));
}

TEST_F(CommandLine, EditOnTheDeviceDrawsBothPictures) {
  LAPWING_NEEDS_GPU();
  succeed(kLiftFlags + "--render a.png --render-before b.png --size 160x120");
  EXPECT_THAT(read("a.png"), ::testing::StartsWith("\x89PNG"));
  EXPECT_NE(read("a.png"), read("b.png"));
}

TEST_F(CommandLine, EditDrawsHowItsResultDiffersFromWhatWasThere) {
  LAPWING_NEEDS_GPU();
  std::set<std::string> pictures;
  for (const std::string color : {"plain", "regions", "displacement", "rotation", "detail"}) {
    succeed(kLiftFlags + "--render a.png --size 160x120 --color " + color);
    EXPECT_TRUE(pictures.insert(read("a.png")).second) << color << " looks like another one";
  }
}

TEST_F(CommandLine, TurntableWritesNumberedPicturesOfOneSizeFromAllAround) {
  LAPWING_NEEDS_GPU();
  succeed("render tube.obj --turntable 4 -o t.png --size 160x120");
  EXPECT_EQ(files_called(folder_.path(), "t-"), 4U);
  EXPECT_FALSE(std::filesystem::exists(file("t.png")));
  EXPECT_TRUE(read("t-0001.png") != read("t-0002.png"));
  const std::string first = read("t-0001.png");
  succeed("render tube.obj --turntable 2 -o t.png --size 160x120");
  EXPECT_TRUE(read("t-0001.png") == first) << "however many there are";
}

TEST_F(CommandLine, TurntableHandsAVideosPicturesToFfmpeg) {
  LAPWING_NEEDS_GPU();
  const test::StandInFfmpeg ffmpeg(folder_.path());
  succeed("render tube.obj --turntable 3 --fps 12 -o t.webm --size 160x120");
  EXPECT_EQ(read("t.webm").size(), 3U * 160 * 120 * 4);
  EXPECT_THAT(read("arguments"), HasSubstr("-framerate\n12.000000\n"));
}

TEST_F(CommandLine, TurntableSaysWhatItCannotWrite) {
  expect_refused("render tube.obj --turntable 3 -o t.avi", 3, {".webm"});
  const Outcome none = lapwing("render tube.obj --turntable 3 -o t.mp4", "PATH=/nowhere");
  EXPECT_EQ(none.exit_code, 6);
  EXPECT_THAT(none.output, HasSubstr("install the package ffmpeg"));
  EXPECT_EQ(lapwing("render tube.obj -o t.mp4").exit_code, 2) << "a single picture";
  expect_refused("render tube.obj --fps 12 -o t.png", 2);
  expect_refused("render tube.obj --turntable 0 -o t.png", 2);
  EXPECT_EQ(files_called(folder_.path(), "t."), 0U);
}

TEST_F(CommandLine, InterruptedTurntableLeavesNoHalfFile) {
  LAPWING_NEEDS_GPU();
  const test::StandInFfmpeg ffmpeg(folder_.path());
  write("t.mp4", "old");
  const std::string render = "render tube.obj --turntable 100000 --size 160x120 -o ";
  write("interrupt", kInterrupt);
  const Outcome video = lapwing(render + "t.mp4", "sh interrupt arguments");
  EXPECT_EQ(video.exit_code, 130) << video.output;
  EXPECT_THAT(video.output, HasSubstr("nothing was written"));
  EXPECT_EQ(read("t.mp4"), "old");
  const Outcome pictures = lapwing(render + "t.png", "sh interrupt t-000002.png");
  EXPECT_EQ(pictures.exit_code, 130) << pictures.output;
  EXPECT_THAT(pictures.output, HasSubstr("of 100000 pictures are written"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("t-")) continue;
    EXPECT_TRUE(name.ends_with(".png"));
    EXPECT_TRUE(read(name).ends_with(std::string("IEND\xAE\x42\x60\x82"))) << name;
  }
  EXPECT_EQ(files_called(folder_.path(), ".tmp-"), 0U);
}

}  // namespace
}  // namespace lapwing
