#include "lapwing/run/session.h"

#include <array>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/run/run_recipe.h"
#include "support/split_meshes.h"

namespace lapwing {
namespace {

using ::testing::Contains;
using ::testing::Not;

std::string lift(const std::string& translate, const std::string& keys = "") {
  return R"({"op": "deform", "roi": {"all": true},
    "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.4]}},
    "handles": [{"region": {"box": {"min": [-1, -1, 2.8], "max": [1, 1, 4]}},
                 "move": {"translate": )" +
         translate + R"(, "rotate": {"axis": [0, 1, 0], "degrees": 40}}}])" + keys + "}";
}

std::string draw(const std::string& target, bool hard) {
  return R"({"op": "deform", "roi": {"all": true},
    "belt": {"vertices": [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]},
    "targets": {"rows": [[130, )" +
         target + R"(], [70, 0.5, 0, 1]], "hard": )" + (hard ? "true" : "false") + "}}";
}

std::string coat(const std::string& amplitude) {
  return R"({"op": "coat", "source": "bumps.obj", "source_patch": {"all": true},
    "target_patch": {"disk": {"center": 130, "radius": 0.5}}, "detail_size": 0.2,
    "amplitude": )" +
         amplitude + "}";
}

std::vector<std::string> stages_of(const StepReport& step) {
  std::vector<std::string> names;
  for (const auto& [name, ms] : step.timings.stages()) names.push_back(name);
  return names;
}

class ASession : public ::testing::Test {
 protected:
  void SetUp() override {
    write_mesh(cylinder(12, 20, 0.5, 3.0), folder_.path() / "tube.obj");
    write_mesh(cylinder(14, 24, 0.5, 3.0), folder_.path() / "fine.obj");
    write_mesh(grid(20, 20), folder_.path() / "bumps.obj");
  }

  Recipe recipe(const std::vector<std::string>& steps, const std::string& mesh = "tube.obj") const {
    std::string text;
    for (const std::string& step : steps) text += (text.empty() ? "" : ", ") + step;
    return parse_recipe(R"({"lapwing": 1, "mesh": ")" + mesh + R"(", "steps": [)" + text + "]}",
                        folder_.path(), "test");
  }

  void expect_like_alone(const Recipe& recipe, const RunResult& result) {
    const auto alone = run_recipe(recipe, kernels_);
    EXPECT_TRUE(same_bits(result.mesh.positions, alone->mesh.positions));
    EXPECT_TRUE(same_bits(result.original, alone->original));
    EXPECT_EQ(result.mesh.face_vertices(), alone->mesh.face_vertices());
    EXPECT_EQ(result.region, alone->region);
    EXPECT_EQ(result.inputs, alone->inputs);
    EXPECT_EQ(result.report.warnings, alone->report.warnings);
    EXPECT_EQ(result.report.notes, alone->report.notes);
    EXPECT_EQ(result.report.steps.size(), alone->report.steps.size());
  }

  TemporaryFolder folder_;
  CpuKernels kernels_;
  MeshCache shelf_;
  Session session_{kernels_, shelf_};
};

TEST_F(ASession, SolvesWithoutPreparingWhereOnlyTheMoveDiffers) {
  const auto prepared = session_.run(recipe({lift("[0, 0, 0.5]")}));
  EXPECT_THAT(stages_of(prepared->report.steps[0]), Contains("laplacian"));
  const auto next = session_.run(recipe({lift("[0.2, 0, 0.5]")}));
  EXPECT_THAT(stages_of(next->report.steps[0]), Not(Contains("laplacian")));
  EXPECT_THAT(stages_of(next->report.steps[0]), Contains("solve"));
}

TEST_F(ASession, CarriesOutOnceWhatRecipesBeginWith) {
  const std::vector<std::string> once{lift("[0, 0, 0.5]"), draw("0.7, 0, 1.5", false)};
  const std::vector<std::string> twice{lift("[0, 0, 0.5]"), draw("0.8, 0, 1.5", false)};
  session_.run(recipe(once));
  session_.run(recipe(twice));
  int solves = 0;
  const Progress count = [&](std::string_view stage, double) {
    solves += stage == "solve" ? 1 : 0;
    return true;
  };
  session_.run(recipe(once), count);
  EXPECT_EQ(solves, 1);
}

// In any order, what was run before makes no difference.
TEST_F(ASession, GivesTheBitsOfEachRecipeAlone) {
  std::vector<Recipe> recipes;
  for (const char* const mesh : {"tube.obj", "fine.obj"}) {
    for (const char* const move : {"[0, 0, 0.5]", "[0.4, 0, -1]", "[0, 0, -2.7]"}) {
      for (const char* const keys :
           {"", R"(, "commit_every": 15)", R"(, "hard": true)", R"(, "settle": false)"}) {
        recipes.push_back(recipe({lift(move, keys)}, mesh));
      }
      recipes.push_back(recipe({lift(move), draw("0.7, 0, 1.5", false)}, mesh));
      recipes.push_back(recipe({lift(move), draw("0.8, 0.1, 1.5", true), coat("1")}, mesh));
    }
    for (const char* const amplitude : {"1", "0.5"}) {
      recipes.push_back(recipe({coat(amplitude), lift("[0, 0, 0.5]")}, mesh));
      recipes.push_back(recipe({coat(amplitude), lift("[0, 0.2, 0.5]")}, mesh));
    }
    recipes.push_back(recipe({}, mesh));
  }
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same every time
  for (int round = 0; round < 2; ++round) {
    for (const Recipe& each : recipes) expect_like_alone(each, *session_.run(each));
    std::shuffle(recipes.begin(), recipes.end(), random);
  }
}

TEST_F(ASession, GivesTheBitsOfEachRecipeAloneOnAMeshWithSeams) {
  const Mesh seamed = test::halves(cylinder(12, 20, 0.5, 3.0)).mesh;
  write_mesh(seamed, folder_.path() / "tube.obj");
  for (const char* const keys : {"", R"(, "seams": "leave")", ""}) {
    for (const char* const move : {"[0, 0, 0.5]", "[0.4, 0, 0]"}) {
      for (const std::vector<std::string>& steps :
           {std::vector{lift(move, keys)}, {lift("[0, 0, 0.2]", keys), lift(move)}}) {
        const Recipe each = recipe(steps);
        expect_like_alone(each, *session_.run(each));
      }
    }
  }
}

TEST_F(ASession, GoesOnAfterARecipeThatFails) {
  session_.run(recipe({lift("[0, 0, 0.5]")}));
  const std::string beyond =
      R"({"op": "deform", "roi": {"all": true}, "belt": {"vertices": [99999]},
    "handles": [{"region": {"vertices": [0]}, "move": {"translate": [1, 0, 0]}}]})";
  EXPECT_THROW(session_.run(recipe({lift("[0, 0, 0.5]"), beyond})), InputError);
  EXPECT_THROW(session_.run(recipe({beyond})), InputError);
  EXPECT_THROW(session_.run(recipe({lift("[0, 0, 0.5]")}, "none.obj")), IoError);
  const Recipe next = recipe({lift("[0, 0.3, 0.5]"), draw("0.7, 0, 1.5", false)});
  expect_like_alone(next, *session_.run(next));
}

}  // namespace
}  // namespace lapwing
