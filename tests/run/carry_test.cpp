// Files that follow the surface, from recipe to file.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/point_table.h"
#include "lapwing/mesh/shapes.h"
#include "run/recipe_runs.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Carry : public test::RecipeRuns {
 protected:
  Carry() : RecipeRuns("tube.obj") {}

  void SetUp() override { write_mesh(cylinder(12, 20, 0.5, 3.0), file("tube.obj")); }

  fs::path file(const std::string& name) const { return folder_.path() / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(file(name)).rdbuf();
    return text.str();
  }
  // Turns the tube's head by `degrees`, foot held, and carries what `carry` lists.
  static std::string turn(double degrees, const std::string& carry) {
    return R"({"op": "deform", "roi": {"all": true}, "hard": true,
      "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.4]}},
      "handles": [{"region": {"box": {"min": [-1, -1, 2.6], "max": [1, 1, 4]}},
                   "move": {"rotate": {"axis": [0, 0, 1], "degrees": )" +
           std::to_string(degrees) + R"(}}}], "carry": [)" + carry + "]}";
  }
  // Expects that `save_result` fails without writing a file. Returns the error message.
  std::string refused(const std::string& steps, const std::string& result = "out.obj") {
    const auto run_result = run(steps);
    const std::string message =
        error_message<InputError>([&] { save_result(*run_result, file(result)); });
    EXPECT_FALSE(fs::exists(file("out.obj")));
    return message;
  }
};

TEST_F(Carry, StillEditKeepsEveryByte) {
  write("points.csv", "x, y, z\n0.60, 0.0, 2.90\n+1e0, 2, 3.000\n");
  write("hat.obj", "# a hat\nv 0.60 0.0 2.90\nv 1 0 3.0\nv 0 1 3.0\nf 1 2 3\n");
  const auto result = run(turn(0.0, R"("points.csv", "hat.obj")"));
  EXPECT_FALSE(fs::exists(file("points-carried.csv"))) << "nothing is written before the result";
  save_result(*result, file("out.obj"));
  EXPECT_EQ(read("points-carried.csv"), read("points.csv"));
  EXPECT_EQ(read("hat-carried.obj"), read("hat.obj"));
}

TEST_F(Carry, StepsCarryOnFromWhereTheStepBeforeLeftAFile) {
  write("points.csv", "0.6,0,2.9,1,0,0\n");
  write("once.csv", "0.6,0,2.9,1,0,0\n");
  const auto result = run(turn(60.0, R"("points.csv", "once.csv")") + ", " +
                          turn(30.0, R"({"file": "points.csv", "save": "there.csv"})"));
  save_result(*result, file("out.obj"));
  const PointTable twice = read_point_table(file("there.csv"));
  EXPECT_LT((twice.positions[0] - Vector3d(0, 0.6, 2.9)).norm(), 0.01);
  EXPECT_LT((twice.normals[0] - Vector3d(0, 1, 0)).norm(), 0.02);
  const PointTable once = read_point_table(file("once-carried.csv"));
  EXPECT_LT((once.positions[0] - Vector3d(0.3, 0.6 * std::sqrt(0.75), 2.9)).norm(), 0.01);
}

TEST_F(Carry, QuaternionsOfTablesAndCloudsTurnAlong) {
  write("frames.txt", "0.6 0 2.9 1 0 0 0\n");
  write("cloud.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty double x\nproperty double y\n"
        "property double z\nproperty uchar mark\nproperty double qw\nproperty double qx\n"
        "property double qy\nproperty double qz\nend_header\n0.6 0 2.9 7 0 1 0 0\n");
  const auto result = run(turn(90.0, R"("frames.txt", "cloud.ply")"));
  save_result(*result, file("out.obj"));
  const double half = std::sqrt(0.5);
  const Eigen::Quaterniond q = read_point_table(file("frames-carried.txt")).rotations[0];
  EXPECT_LT((q.coeffs() - Eigen::Vector4d(0, 0, half, half)).norm(), 0.02);
  // A quarter turn about z after the half turn about x.
  const Mesh cloud = read_mesh(file("cloud-carried.ply"));
  const std::vector<ExtraAttribute>& extras = cloud.attributes().vertex_extras;
  ASSERT_EQ(extras.size(), 5U);
  EXPECT_EQ(extras[0].values[0], 7.0);
  EXPECT_NEAR(extras[2].values[0], half, 0.02);
  EXPECT_NEAR(extras[3].values[0], half, 0.02);
}

TEST_F(Carry, NamesOfPointsStayBesideThem) {
  write("named.csv", "name,x,y,z\nM1,0.6,0,2.9\n2,0.6,0,0.1\n");
  write("F.mrk.json", R"({"markups": [{"controlPoints": [
    {"label": "F-1", "position": [0.6, 0, 2.9]}]}]})");
  EXPECT_THAT(refused(turn(9.0, R"({"file": "F.mrk.json", "save": "G.json"})")),
              HasSubstr("end its name in .mrk.json"));
  const auto result = run(turn(90.0, R"("named.csv", "F.mrk.json")"));
  save_result(*result, file("out.obj"));
  EXPECT_THAT(read("named-carried.csv"), StartsWith("name,x,y,z\nM1,"));
  EXPECT_THAT(read("named-carried.csv"), HasSubstr("\n2,0."));
  EXPECT_THAT(read("F-carried.mrk.json"), HasSubstr(R"({"label": "F-1", "position": [)"));
  for (const char* name : {"named-carried.csv", "F-carried.mrk.json"}) {
    const Positions moved = read_point_table(file(name)).positions;
    EXPECT_LT((moved[0] - Vector3d(0, 0.6, 2.9)).norm(), 0.01) << name;
  }
}

TEST_F(Carry, NothingThatWasReadOrIsWrittenIsOverwritten) {
  write("points.csv", "0.6,0,2.9\n");
  write("other.csv", "0.6,0,2.9\n");
  EXPECT_THAT(refused(turn(9.0, R"({"file": "points.csv", "save": "./points.csv"})")),
              HasSubstr("which is an input of the edit; give it another name with \"save\""));
  EXPECT_THAT(refused(turn(9.0, R"({"file": "points.csv", "save": "other.csv"}, "other.csv")")),
              HasSubstr("which is an input of the edit"));
  EXPECT_THAT(refused(turn(9.0, R"({"file": "points.csv", "save": "a.csv"},
                                   {"file": "other.csv", "save": "a.csv"})")),
              HasSubstr("which is another result of the edit"));
  EXPECT_THAT(refused(turn(9.0, R"({"file": "points.csv", "save": "points.npy"})")),
              HasSubstr("a table keeps its format; end its name in .csv"));
  EXPECT_EQ(read("points.csv"), "0.6,0,2.9\n");
  EXPECT_THAT(refused(turn(9.0, R"("points.csv")"), "out.xyz"), HasSubstr("out.xyz"));
  EXPECT_FALSE(fs::exists(file("points-carried.csv")));
  write_mesh(icosphere(1), file("hat.obj"));
  EXPECT_THAT(refused(turn(9.0, R"({"file": "hat.obj", "save": "out.obj"})")),
              HasSubstr("which is another result of the edit"));
  EXPECT_THAT(refused(turn(9.0, R"({"file": "hat.obj", "save": "tube.obj"})")),
              HasSubstr("which is an input of the edit"));
}

TEST_F(Carry, KeyComesBackAsItWasWritten) {
  const std::string text = R"({"lapwing": 1, "mesh": "tube.obj", "steps": [)" +
                           turn(9.0, R"("hat.obj", {"file": "a.csv", "save": "b.csv"})") + "]}";
  const Recipe recipe = parse_recipe(text, folder_.path(), "test");
  const std::string again = to_json(recipe);
  EXPECT_THAT(again, HasSubstr(R"("carry": ["hat.obj", {"file": "a.csv", "save": "b.csv"}])"));
  EXPECT_EQ(parse_recipe(again, folder_.path(), "test"), recipe);
}

}  // namespace
}  // namespace lapwing
