// Tests `lapwing transfer`.
#include <fstream>

#include "cli/command_line.h"
#include "support/largest_distance.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class TransferCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    succeed(kLiftFlags + "--save pose.obj --quiet");
    succeed(kLiftFlags + "--rotate 0,1,0,40 --save turn.obj --quiet");
    succeed("subdivide tube.obj -o target.ply");
    succeed("subdivide pose.obj -o expected.ply");
  }
  void expect_pose(const std::string& name) const {
    const Mesh expected = read_mesh(file("expected.ply"));
    EXPECT_LT(test::largest_distance(read_mesh(file(name)).positions, expected.positions),
              2e-3 * bounds_of(expected.positions).diagonal());
  }
};

TEST_F(TransferCommand, WritesTheTargetInThePose) {
  EXPECT_THAT(succeed("transfer tube.obj pose.obj --onto target.ply --aligned -o posed.ply"),
              AllOf(HasSubstr("target wrapped onto the rest pose"), HasSubstr("no counterpart"),
                    HasSubstr("posed.ply: pose pose.obj"), HasSubstr("flipped triangles 0")));
  expect_pose("posed.ply");
}

TEST_F(TransferCommand, WritesAFilePerPoseOfAFolderByACorrespondence) {
  std::filesystem::create_directory(file("walk"));
  for (const char* name : {"pose.obj", "turn.obj"}) {
    std::filesystem::rename(file(name), file("walk") / name);
  }
  write("walk/notes.txt", "not a mesh");
  // The target lies on the rest pose, so that it is its own correspondence.
  EXPECT_THAT(
      succeed("transfer tube.obj walk --onto target.ply --correspondence target.ply -o posed"),
      AllOf(HasSubstr("posed/pose.ply"), HasSubstr("posed/turn.ply")));
  expect_pose("posed/pose.ply");
  EXPECT_EQ(succeed("transfer tube.obj walk/pose.obj walk/turn.obj --onto target.ply "
                    "--correspondence target.ply -o again --quiet"),
            "");
  EXPECT_EQ(read("again/turn.ply"), read("posed/turn.ply"));
}

TEST_F(TransferCommand, TransfersMorphTargets) {
  succeed("convert tube.obj tube.glb");
  succeed("convert target.ply target.glb");
  Mesh tube = read_mesh(file("tube.glb"));
  std::vector<MorphTarget> targets{{"long", tube.positions}, {"still", tube.positions}};
  for (Eigen::Vector3d& p : targets[0].positions) p.z() *= 1.5;
  write_mesh(tube, file("morphs.glb"), {.morph_targets = targets});
  EXPECT_THAT(
      succeed("transfer morphs.glb --morph-targets --onto target.glb --aligned -o done.glb"),
      AllOf(HasSubstr("done.glb: morph target long"), HasSubstr("done.glb: morph target still")));
  const Mesh done = read_mesh(file("done.glb"));
  const std::vector<MorphTarget> found = read_morph_targets(done);
  ASSERT_EQ(found.size(), 2U);
  const double size = bounds_of(done.positions).diagonal();
  EXPECT_NEAR(bounds_of(found[0].positions).max.z(), 1.5 * bounds_of(done.positions).max.z(),
              0.01 * size);
  EXPECT_LT(test::largest_distance(found[1].positions, done.positions), 1e-6 * size);
  expect_refused("transfer tube.glb --morph-targets --onto target.glb -o x.glb", 3,
                 {"--morph-targets: tube.glb has no morph targets"});
  expect_refused("transfer morphs.glb --morph-targets --onto target.ply --aligned -o x.glb", 3,
                 {"the morph target 'long' needs a glTF file"});
  expect_refused("transfer morphs.glb --onto target.glb -o x.glb", 2, {"--morph-targets"});
}

TEST_F(TransferCommand, HoldsVerticesOfTheTarget) {
  succeed("transfer tube.obj turn.obj --onto tube.obj --hold box:-1,-1,-1,1,1,0 -o posed.obj");
  const Mesh posed = read_mesh(file("posed.obj"));
  const Mesh rest = read_mesh(file("tube.obj"));
  for (Index v = 0; v < rest.vertex_count(); ++v) {
    if (rest.positions[v].z() > 0.0) continue;
    EXPECT_LT((posed.positions[v] - rest.positions[v]).norm(), 1e-3) << v;
  }
}

TEST_F(TransferCommand, GivesTheSameBitsWithAnyNumberOfThreads) {
  const std::string command = "transfer tube.obj turn.obj --onto target.ply --aligned -o ";
  succeed(command + "one.ply", "LAPWING_THREADS=1");
  for (const char* threads : {"2", "5", "8"}) {
    succeed(command + "many.ply", std::string("LAPWING_THREADS=") + threads);
    EXPECT_TRUE(read("many.ply") == read("one.ply")) << threads;
  }
}

TEST_F(TransferCommand, RefusesFilesThatDoNotFit) {
  expect_refused("transfer tube.obj target.ply --onto tube.obj -o x.obj", 3,
                 {"target.ply: it has", "same vertices"});
  expect_refused("transfer tube.obj pose.obj --onto target.ply --correspondence tube.obj -o x.ply",
                 3, {"correspondence", "one for each vertex"});
  expect_refused("transfer tube.obj pose.obj --onto target.ply -o pose.obj", 2, {"POSED"});
  std::filesystem::create_directory(file("walk"));
  std::filesystem::copy(file("pose.obj"), file("walk") / "pose.obj");
  expect_refused("transfer tube.obj pose.obj walk --onto target.ply -o x", 3,
                 {"another pose is also named pose"});
  expect_refused("transfer tube.obj walk --onto target.ply -o tube.obj", 6,
                 {"cannot create the folder tube.obj"});
  std::filesystem::create_directory(file("empty"));
  expect_refused("transfer tube.obj empty --onto target.ply -o x", 3, {"no mesh files"});
}

TEST_F(TransferCommand, MissingCounterpartsAreAnErrorIfStrict) {
  // Where the correspondence is inside out, no normal agrees with that of the rest pose.
  Mesh inverted = read_mesh(file("tube.obj"));
  for (Eigen::Vector3d& p : inverted.positions) {
    if (p.z() < 2.0) p.x() = -p.x();
  }
  write_mesh(inverted, file("inverted.obj"));
  const std::string command =
      "transfer tube.obj pose.obj --onto tube.obj --correspondence inverted.obj -o x.obj ";
  EXPECT_THAT(succeed(command), HasSubstr("of the target has no counterpart on the source"));
  EXPECT_EQ(lapwing(command + "--strict").exit_code, 4);
}

}  // namespace
}  // namespace lapwing
