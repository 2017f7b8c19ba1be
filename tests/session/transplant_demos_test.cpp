#include <algorithm>

#include "lapwing/doctor/self_intersections.h"
#include "session/dihedral_angles.h"
#include "session/transplant_runs.h"
#include "support/models.h"

// The recipes that tools/transplants shows.
namespace lapwing::test {
namespace {

namespace fs = std::filesystem;

struct Demo {
  const char* recipe;
  std::size_t own_holes;  // of the part, beside the loop that is sewn on
};

class TransplantDemos : public ::testing::TestWithParam<Demo> {
 protected:
  // The recipe, its files where the packages' meshes are.
  static Recipe recipe(const std::string& name) {
    Recipe recipe = read_recipe(fs::path(LAPWING_RECIPES_DIR) / (name + ".json"));
    const fs::path meshes = models_folder() / "cgal" / "meshes";
    recipe.mesh = meshes / recipe.mesh.filename();
    for (Step& step : recipe.steps) {
      auto& transplant = std::get<TransplantStep>(step);
      transplant.part = meshes / transplant.part.filename();
    }
    return recipe;
  }
};

TEST_P(TransplantDemos, AreClosedSmoothAndFreeOfSelfIntersections) {
  LAPWING_NEEDS_MODELS(models, "cgal");
  const Recipe whole = recipe(GetParam().recipe);
  CpuKernels cpu;
  // Each step by itself, since the result says where the last one was.
  for (std::size_t count = 1; count <= whole.steps.size(); ++count) {
    Recipe part = whole;
    part.steps.resize(count);
    const auto& last = std::get<TransplantStep>(part.steps.back());
    const auto result = run_recipe(part, cpu);
    expect_whole(*result, GetParam().own_holes);
    const TransplantReport& report = *result->report.steps.back().transplant;
    EXPECT_EQ(report.flipped, 0U);
    EXPECT_FALSE(report.turned);

    const std::vector<char> zone = vertex_mask(result->mesh.vertex_count(), result->region.roi);
    std::vector<Triangle> transition;
    for (const Triangle& t : result->mesh.topology().triangles) {
      if (std::all_of(t.begin(), t.end(), [&](Index v) { return zone[v] != 0; })) {
        transition.push_back(t);
      }
    }
    EXPECT_TRUE(self_intersections(transition, result->mesh.positions).empty());

    const double allowed = std::max(percentile(dihedral_angles(read_mesh(part.mesh)), 0.99),
                                    percentile(dihedral_angles(read_mesh(last.part)), 0.99));
    EXPECT_LE(report.seam_degrees, allowed);
  }
}
INSTANTIATE_TEST_SUITE_P(Recipes, TransplantDemos,
                         ::testing::Values(Demo{"transplant-wings", 0}, Demo{"transplant-ears", 0},
                                           Demo{"transplant-head", 3}));

}  // namespace
}  // namespace lapwing::test
