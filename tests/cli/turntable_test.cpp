// Pictures from all around, as a user of the command line gets them.
#include <gmock/gmock.h>

#include "cli/command_line.h"
#include "support/gpu.h"
#include "support/stand_in_ffmpeg.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;

// `sh interrupt FILE PROGRAM ...` runs the program until that file is there, and interrupts it
// then, as Ctrl+C does.
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

TEST_F(CommandLine, TurntableWritesNumberedPicturesOfOneSizeFromAllAround) {
  LAPWING_NEEDS_GPU();
  const Outcome outcome = lapwing("render tube.obj --turntable 4 -o t.png --size 160x120");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(files_called(folder_.path(), "t-"), 4U);
  EXPECT_FALSE(std::filesystem::exists(file("t.png")));
  EXPECT_TRUE(read("t-0001.png") != read("t-0002.png"));
  const std::string first = read("t-0001.png");
  ASSERT_EQ(lapwing("render tube.obj --turntable 2 -o t.png --size 160x120").exit_code, 0);
  EXPECT_TRUE(read("t-0001.png") == first) << "however many there are";
}

TEST_F(CommandLine, TurntableHandsAVideosPicturesToFfmpeg) {
  LAPWING_NEEDS_GPU();
  const test::StandInFfmpeg ffmpeg(folder_.path());
  const Outcome outcome =
      lapwing("render tube.obj --turntable 3 --fps 12 -o t.webm --size 160x120");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(read("t.webm").size(), 3U * 160 * 120 * 4);
  EXPECT_THAT(read("arguments"), HasSubstr("-framerate\n12.000000\n"));
}

TEST_F(CommandLine, TurntableSaysWhatItCannotWrite) {
  const Outcome other = lapwing("render tube.obj --turntable 3 -o t.avi");
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_THAT(other.output, HasSubstr(".webm"));
  const Outcome none = lapwing("render tube.obj --turntable 3 -o t.mp4", "PATH=/nowhere");
  EXPECT_EQ(none.exit_code, 6);
  EXPECT_THAT(none.output, HasSubstr("install the package ffmpeg"));
  EXPECT_EQ(lapwing("render tube.obj -o t.mp4").exit_code, 2) << "a single picture";
  EXPECT_EQ(lapwing("render tube.obj --fps 12 -o t.png").exit_code, 2);
  EXPECT_EQ(lapwing("render tube.obj --turntable 0 -o t.png").exit_code, 2);
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
