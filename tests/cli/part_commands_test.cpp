// `lapwing cut` and `lapwing parts` as a user meets them.
#include <gmock/gmock.h>

#include "cli/command_line.h"
#include "io/rich_mesh.h"
#include "support/gpu.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class PartCommands : public CommandLine {
 protected:
  void SetUp() override { write_mesh(icosphere(3), file("ball.obj")); }
};

const char* const kCutCap = "cut ball.obj --region box:-1,-1,0.5,1,1,1 -o cap.obj ";

TEST_F(PartCommands, CutWritesPartAndRestWithTheirLoops) {
  const Outcome outcome = lapwing(std::string(kCutCap) + "--rest rest.ply");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("cap.obj: "), HasSubstr("rest.ply: "),
                                    HasSubstr("  loop 0: "), Not(HasSubstr("loop 1"))));
  EXPECT_EQ(read_mesh(file("cap.obj")).face_count() + read_mesh(file("rest.ply")).face_count(),
            icosphere(3).face_count());
  const Outcome quiet = lapwing(std::string(kCutCap) + "--quiet");
  EXPECT_EQ(quiet.exit_code, 0);
  EXPECT_EQ(quiet.output, "");
}

TEST_F(PartCommands, CutKeepsWhatTheMeshCarries) {
  write_mesh(rich_mesh(), file("rich.ply"));
  const Outcome outcome = lapwing("cut rich.ply --region 0,1,5,6 -o corner.ply");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const Mesh rich = read_mesh(file("rich.ply"));
  const Mesh corner = read_mesh(file("corner.ply"));
  ASSERT_EQ(corner.vertex_count(), 4U);
  EXPECT_EQ(corner.attributes().vertex_colors.at(2), rich.attributes().vertex_colors.at(5));
  EXPECT_EQ(corner.attributes().vertex_extras.at(0).values.at(3), 600000);
  EXPECT_EQ(corner.attributes().comments, rich.attributes().comments);
}

TEST_F(PartCommands, CutSaysWhatIsOddAboutAPart) {
  const std::string two = R"('{"union": [{"box": {"min": [-1,-1,0.8], "max": [1,1,1]}},
                                         {"box": {"min": [-1,-1,-1], "max": [1,1,-0.8]}}]}')";
  const Outcome outcome = lapwing("cut ball.obj -o caps.obj --rest belt.obj --region " + two);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("caps.obj is in 2 pieces"),
                                    HasSubstr("belt.obj has several boundary loops")));
}

TEST_F(PartCommands, CutThatLeavesNothingWritesNothing) {
  const Outcome outcome = lapwing("cut ball.obj --region all -o part.obj --rest rest.obj");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("--region"), HasSubstr("nothing remains")));
  EXPECT_FALSE(std::filesystem::exists(file("part.obj")));
  EXPECT_EQ(lapwing("cut ball.obj -o part.obj").exit_code, 2) << "without a region";
}

TEST_F(PartCommands, PartsAreAddedListedAndShown) {
  ASSERT_EQ(lapwing(kCutCap).exit_code, 0);
  const Outcome added = lapwing("parts add shelf cap.obj --name dome --no-pictures");
  ASSERT_EQ(added.exit_code, 0) << added.output;
  EXPECT_THAT(added.output, StartsWith("dome: "));
  const Outcome listed = lapwing("parts list shelf --no-pictures");
  ASSERT_EQ(listed.exit_code, 0) << listed.output;
  EXPECT_EQ(listed.output, added.output);
  const Outcome shown = lapwing("parts show shelf dome");
  ASSERT_EQ(shown.exit_code, 0) << shown.output;
  EXPECT_THAT(shown.output, AllOf(HasSubstr("dome.obj"), HasSubstr("loop 0: ")));
}

TEST_F(PartCommands, BrokenFileIsNamedAndTheOthersAreListed) {
  std::filesystem::create_directory(file("shelf"));
  write_mesh(cylinder(12, 20, 0.5, 3.0), file("shelf/tube.obj"));
  write_mesh(icosphere(1), file("shelf/ball.obj"));
  write("shelf/broken.obj", "v 1 2\n");
  write("shelf/notes.txt", "no mesh");
  const Outcome outcome = lapwing("parts list shelf --no-pictures");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("skipped shelf/broken.obj"), HasSubstr("skipped shelf/ball.obj"),
                    HasSubstr("tube: 240 vertices"), Not(HasSubstr("notes.txt"))));
}

TEST_F(PartCommands, WhatIsNoPartIsRefused) {
  const Outcome closed = lapwing("parts add shelf ball.obj");
  EXPECT_EQ(closed.exit_code, 3);
  EXPECT_THAT(closed.output, HasSubstr("lapwing cut"));
  EXPECT_EQ(lapwing("parts list nowhere").exit_code, 6);
  EXPECT_EQ(lapwing("parts").exit_code, 2);
}

TEST_F(PartCommands, PicturesAreDrawnWhenTheyAreNeeded) {
  LAPWING_NEEDS_GPU();
  ASSERT_EQ(lapwing(kCutCap).exit_code, 0);
  ASSERT_EQ(lapwing("parts add shelf cap.obj").exit_code, 0);
  EXPECT_THAT(read("shelf/cap.png"), StartsWith("\x89PNG"));
  write("shelf/cap.png", "kept while it is new");
  ASSERT_EQ(lapwing("parts list shelf").exit_code, 0);
  EXPECT_EQ(read("shelf/cap.png"), "kept while it is new");
  std::filesystem::remove(file("shelf/cap.png"));
  ASSERT_EQ(lapwing("parts list shelf").exit_code, 0);
  EXPECT_THAT(read("shelf/cap.png"), StartsWith("\x89PNG"));
  ASSERT_EQ(lapwing("parts show shelf cap -o large.png --size 64").exit_code, 0);
  EXPECT_THAT(read("large.png"), StartsWith("\x89PNG"));
}

TEST_F(PartCommands, WithoutADevicePartsStayWithoutPictures) {
  ASSERT_EQ(lapwing(kCutCap).exit_code, 0);
  const Outcome outcome = lapwing("parts add shelf cap.obj --device no-such-device");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("note: parts stay without pictures"));
  EXPECT_FALSE(std::filesystem::exists(file("shelf/cap.png")));
  EXPECT_THAT(lapwing("parts list shelf --device no-such-device").output, HasSubstr("cap: "));
}

}  // namespace
}  // namespace lapwing
