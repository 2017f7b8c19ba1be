// Tests `lapwing wrap`.
#include <fstream>

#include "cli/command_line.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class WrapCommand : public CommandLine {
 protected:
  void SetUp() override {
    write_mesh(icosphere(2), file("ball.obj"));
    Mesh egg = icosphere(3);
    for (Eigen::Vector3d& p : egg.positions) p = p.cwiseProduct(Eigen::Vector3d(1.0, 1.2, 1.5));
    write_mesh(egg, file("egg.ply"));
  }
};

TEST_F(WrapCommand, WritesTheTemplateOnTheScanAndReportsDistances) {
  EXPECT_THAT(succeed("wrap ball.obj egg.ply --aligned -o wrapped.ply"),
              AllOf(HasSubstr("result to scan"), HasSubstr("scan to result"),
                    HasSubstr("100.0% of the template"), HasSubstr("flipped triangles 0")));
  const Mesh wrapped = read_mesh(file("wrapped.ply"));
  EXPECT_EQ(wrapped.face_count(), icosphere(2).face_count());
  EXPECT_NEAR(bounds_of(wrapped.positions).max.z(), 1.5, 0.02);
  EXPECT_EQ(succeed("wrap ball.obj egg.ply --aligned -o quiet.ply --quiet"), "");
}

TEST_F(WrapCommand, ReadsLandmarksFromATable) {
  std::ofstream(file("landmarks.csv")) << "vertex,x,y,z\n0,0,0,1.5\n5,1,0,0\n9,0,1.2,0\n";
  EXPECT_THAT(
      succeed("wrap ball.obj egg.ply --landmarks landmarks.csv -o wrapped.ply"),
      AllOf(HasSubstr("aligned by the landmarks"), HasSubstr("largest error of a landmark")));
  std::ofstream(file("wrong.csv")) << "0,0,0,1.5\n4000,1,0,0\n";
  expect_refused("wrap ball.obj egg.ply --landmarks wrong.csv -o x.ply", 3,
                 {"wrong.csv:2", "4000"});
}

TEST_F(WrapCommand, ReadsLandmarksFromTwoFilesOfPoints) {
  write("ball.csv", "label,x,y,z\na,0,0,1\nb,1,0,0\nc,0,1,0\n");
  write("egg.mrk.json", R"({"markups": [{"coordinateSystem": "RAS", "controlPoints": [
    {"label": "c", "position": [0, -1.2, 0]}, {"label": "a", "position": [0, 0, 1.5]},
    {"label": "b", "position": [-1, 0, 0]}]}]})");
  EXPECT_THAT(succeed("wrap --landmarks ball.csv egg.mrk.json -o wrapped.ply ball.obj egg.ply"),
              HasSubstr("aligned by the landmarks"));
  EXPECT_NEAR(bounds_of(read_mesh(file("wrapped.ply")).positions).max.z(), 1.5, 0.02);
}

TEST_F(WrapCommand, WritesARecipeAndAReport) {
  write("landmarks.json", R"([{"vertex": 0, "position": [0, 0, 1.5]}])");
  succeed(
      "wrap ball.obj egg.ply --aligned --landmarks landmarks.json -o wrapped.ply "
      "--recipe wrap.json --report report.json --quiet");
  EXPECT_THAT(read("report.json"), AllOf(HasSubstr("\"coverage\": 1.0"), HasSubstr("to_scan")));
  expect_recipe_repeats("wrap.json", "wrapped.ply");
}

TEST_F(WrapCommand, PassesOnHowTheTemplateIsWrapped) {
  succeed(
      "wrap ball.obj egg.ply --aligned --hard --mirror x --detail -o wrapped.ply "
      "--recipe wrap.json --quiet");
  EXPECT_THAT(read("wrap.json"), AllOf(HasSubstr("\"hard\": true"), HasSubstr("\"mirror\""),
                                       HasSubstr("\"detail\": true")));
  expect_recipe_repeats("wrap.json", "wrapped.ply");
  expect_refused("wrap ball.obj egg.ply --aligned --mirror 0,0,0,1,0.3,0 -o x.ply", 3,
                 {"--mirror: vertex", "no mirror image"});
  expect_refused("wrap ball.obj egg.ply --mirror w -o x.ply", 2, {"--mirror", "auto"});
}

TEST_F(WrapCommand, ShowsTheDistanceAsColour) {
  succeed("wrap ball.obj egg.ply --aligned -o wrapped.ply --render plain.png --color plain");
  succeed("wrap ball.obj egg.ply --aligned -o wrapped.ply --render far.png --color distance");
  EXPECT_NE(read("plain.png"), read("far.png"));
  expect_refused("decimate ball.obj --share 0.5 --save small.obj --render x.png --color distance",
                 3, {"--color distance", "wrap"});
}

TEST_F(WrapCommand, AFailedWrapIsAnErrorIfStrict) {
  // The scan is inside out, so none of its normals agrees with the template.
  Mesh inverted = icosphere(3);
  for (Eigen::Vector3d& p : inverted.positions) p.x() = -p.x();
  write_mesh(inverted, file("inverted.ply"));
  const std::string command = "wrap ball.obj inverted.ply --aligned -o wrapped.ply ";
  EXPECT_EQ(lapwing(command).exit_code, 0);
  const auto strict = lapwing(command + "--strict");
  EXPECT_EQ(strict.exit_code, 4);
  EXPECT_THAT(strict.output, HasSubstr("Only 0% of the template has a counterpart"));
}

}  // namespace
}  // namespace lapwing
