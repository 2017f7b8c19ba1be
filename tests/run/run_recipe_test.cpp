#include "lapwing/run/run_recipe.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/io/number_table.h"
#include "lapwing/io/source_file.h"
#include "lapwing/mesh/shapes.h"
#include "run/recipe_runs.h"
#include "support/joined_meshes.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

class RunRecipe : public test::RecipeRuns {
 protected:
  RunRecipe() : RecipeRuns("tube.obj") {}

  void SetUp() override { write_mesh(cylinder(12, 20, 0.5, 3.0), folder_.path() / "tube.obj"); }
};

const char* const kLift = R"({"op": "deform", "roi": {"all": true},
  "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.4]}},
  "handles": [{"region": {"box": {"min": [-1, -1, 2.8], "max": [1, 1, 4]}},
               "move": {"translate": [0, 0, 0.5]}}]})";

TEST_F(RunRecipe, DeformsReportsAndKeepsTheOriginal) {
  const auto result = run(kLift);
  ASSERT_EQ(result->report.steps.size(), 1U);
  const StepReport& step = result->report.steps[0];
  EXPECT_EQ(step.roi, 240U);
  EXPECT_EQ(step.free + step.belt + step.handles[0], step.roi);
  EXPECT_LT(step.deform->certificate.relative_residual, 1e-9);
  EXPECT_NEAR(result->mesh.positions.back().z() - result->original.back().z(), 0.5, 0.05);
}

TEST_F(RunRecipe, MeasuresEachVertexOfTheRoiWhenAsked) {
  EXPECT_TRUE(run(kLift)->report.steps[0].vertices.vertices.empty());
  const auto result = run(kLift, {}, {.measure_vertices = true});
  const VertexMeasures& measures = result->report.steps[0].vertices;
  EXPECT_EQ(measures.vertices.size(), 240U);
  EXPECT_NEAR(*std::max_element(measures.rotation_degrees.begin(), measures.rotation_degrees.end()),
              result->report.steps[0].deform->certificate.largest_rotation_degrees, 1e-12);
}

TEST_F(RunRecipe, SavesHowEachVertexMovedBesideThePropertiesThatThePlyHas) {
  Mesh tube = cylinder(12, 20, 0.5, 3.0);
  std::vector<double> marks(tube.vertex_count());
  for (std::size_t v = 0; v < marks.size(); ++v) marks[v] = static_cast<double>(v % 7);
  tube.edit_attributes().vertex_extras = {{"mark", "uchar", 1, marks}};
  write_mesh(tube, folder_.path() / "tube.ply", {.encoding = Encoding::ascii});
  const std::string text = R"({"lapwing": 1, "mesh": "tube.ply", "steps": [)";
  const auto result = run_recipe(parse_recipe(text + kLift + "]}", folder_.path(), "test"), cpu_);
  for (const char* name : {"once.ply", "again.ply"}) {
    save_result(*result, folder_.path() / name, {.vertex_motion = true});
    const Mesh saved = read_mesh(folder_.path() / name);
    EXPECT_EQ(saved.source->encoding, Encoding::ascii);
    EXPECT_EQ(saved.positions, result->mesh.positions);
    const std::vector<ExtraAttribute>& extras = saved.attributes().vertex_extras;
    ASSERT_EQ(extras.size(), 9U) << "the old ones, and one of each name";
    EXPECT_EQ(extras[0].values, marks);
    const VertexMotion motion = vertex_motion(tube.positions, saved.positions, saved.topology());
    for (std::size_t v = 0; v < marks.size(); ++v) {
      EXPECT_EQ(extras[3].values[v], motion.displacements[v].z());
      EXPECT_EQ(extras[4].values[v], motion.rotations[v].w());
      EXPECT_EQ(extras[7].values[v], motion.rotations[v].z());
      EXPECT_EQ(extras[8].values[v], motion.stretch[v]);
    }
    result->mesh.edit_attributes() = saved.attributes();
  }
  EXPECT_THAT(error_message<InputError>([&] {
                save_result(*result, folder_.path() / "no.obj", {.vertex_motion = true});
              }),
              HasSubstr("no.obj: OBJ cannot store the motion of each vertex"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "no.obj"));
}

TEST_F(RunRecipe, SavesAMorphTargetThatTheFormatHasNoPlaceForAsATable) {
  const std::string text = R"({"lapwing": 1, "mesh": "tube.obj",
      "save_as": {"morph_target": "smile"}, "steps": [)";
  const auto result = run_recipe(parse_recipe(text + kLift + "]}", folder_.path(), "test"), cpu_);
  save_result(*result, folder_ / "out.obj");
  EXPECT_EQ(content_of(folder_ / "out.obj"), content_of(folder_ / "tube.obj"));
  EXPECT_THAT(result->report.warnings, Contains(HasSubstr("out-smile.npy")));
  const NumberTable table = read_number_table(folder_ / "out-smile.npy");
  ASSERT_EQ(table.row_count(), result->original.size());
  for (std::size_t v = 0; v < table.row_count(); ++v) {
    const Eigen::Vector3d moved = result->mesh.positions[v] - result->original[v];
    EXPECT_EQ(Eigen::Vector3d(table.row(v).data()), moved);
  }
  result->mesh = icosphere(1);
  EXPECT_THAT(error_message<InputError>([&] { save_result(*result, folder_ / "other.obj"); }),
              HasSubstr("a step changed the connectivity, so displacements are undefined"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "other.obj"));
}

TEST_F(RunRecipe, StepsFollowOneAnother) {
  const auto once = run(kLift);
  const std::string still = R"(, {"op": "deform", "roi": {"all": true},
      "belt": {"vertices": [0, 3, 6]},
      "handles": [{"region": {"vertices": [228, 232, 236]}, "move": {}}]})";
  const auto twice = run(kLift + still);
  EXPECT_EQ(twice->report.steps.size(), 2U);
  EXPECT_EQ(twice->mesh.positions, once->mesh.positions) << "a still handle changed the mesh";
}

TEST_F(RunRecipe, SecondStepOnTheSameRoiOrdersNothingAnewAndGivesTheSameBits) {
  const std::string other = R"({"op": "deform", "roi": {"all": true},
      "belt": {"vertices": [0, 3, 6]},
      "handles": [{"region": {"vertices": [228, 232, 236]}, "move": {"translate": [0.3, 0, 0]}}]})";
  const auto both = run(std::string(kLift) + ", " + other);
  const auto ordered = [&](std::size_t step) {
    const auto& stages = both->report.steps[step].timings.stages();
    return std::any_of(stages.begin(), stages.end(),
                       [](const auto& s) { return s.first == "order"; });
  };
  EXPECT_TRUE(ordered(0));
  EXPECT_FALSE(ordered(1));

  const auto once = run(kLift);
  once->deformed = {};
  const Step alone = recipe(other).steps[0];
  run_step(alone, {2, folder_.path(), cpu_, {}, *once, {}});
  EXPECT_EQ(both->mesh.positions, once->mesh.positions);
}

TEST_F(RunRecipe, RegionThatDoesNotFitTheMeshIsNamedByItsPlace) {
  EXPECT_THAT(refusal(R"({"op": "deform", "roi": {"all": true}, "handles": [
                           {"region": {"vertices": [3, 999]}, "move": {}}]})"),
              AllOf(HasSubstr("/steps/0/handles/0/region"), HasSubstr("999")));
}

TEST_F(RunRecipe, ComponentWithoutAnchorIsCarriedOrRefused) {
  Mesh two = cylinder(12, 20, 0.5, 3.0);
  Mesh far = icosphere(1);
  for (auto& p : far.positions) p.x() += 10.0;
  two = test::joined(std::move(two), far);
  write_mesh(two, folder_.path() / "tube.obj");
  EXPECT_THAT(run(kLift)->report.notes, Contains(HasSubstr("1 loose component with 42 vertices")));
  EXPECT_THAT(refusal(std::string(kLift).insert(1, R"("loose": "refuse", )")),
              AllOf(HasSubstr("/steps/0/roi"), HasSubstr("has no anchor"),
                    HasSubstr("42 vertices that contains vertex 240")));
}

TEST_F(RunRecipe, CancellingLeavesNoResult) {
  EXPECT_THROW(run(kLift, [](std::string_view stage, double) { return stage != "shares"; }),
               Cancelled);
}

}  // namespace
}  // namespace lapwing
