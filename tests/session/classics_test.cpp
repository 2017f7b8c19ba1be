// The four test motions of Botsch and Sorkine's survey, from the recipes of tools/classics, on
// coarser meshes of the same shapes.
#include <functional>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide.h"
#include "lapwing/session/run_recipe.h"
#include "support/models.h"

namespace lapwing {
namespace {

// What the recipe does to `mesh`.
Certificate certificate_of(const std::string& recipe_name, const Mesh& mesh) {
  const TemporaryFolder folder;
  Recipe recipe = read_recipe(std::filesystem::path(LAPWING_RECIPES_DIR) / recipe_name);
  recipe.base_directory = folder.path();
  recipe.mesh = "mesh.obj";
  write_mesh(mesh, recipe.mesh_path());
  CpuKernels kernels;
  return run_recipe(recipe, kernels)->report.steps.at(0).deform->certificate;
}

struct Classic {
  const char* name;
  const char* recipe;
  std::function<Mesh()> mesh;
  double degrees;       // by which the handle turns
  double detail_error;  // at most
  double edge_stretch;  // at most
};

std::ostream& operator<<(std::ostream& out, const Classic& classic) {
  return out << classic.name;
}

class Classics : public ::testing::TestWithParam<Classic> {};

TEST_P(Classics, SettleWithoutFlipsFoldsOrLostDetail) {
  const Certificate c = certificate_of(GetParam().recipe, GetParam().mesh());
  EXPECT_TRUE(c.settled);
  EXPECT_EQ(c.flipped_triangles, 0U);
  EXPECT_GE(c.largest_rotation_degrees, GetParam().degrees - 1.0);
  EXPECT_LT(c.detail_error, GetParam().detail_error);
  EXPECT_LT(c.edge_stretch, GetParam().edge_stretch);
}

INSTANTIATE_TEST_SUITE_P(
    Survey, Classics,
    ::testing::Values(Classic{"LiftedPlane", "lift-plane.json",
                              [] { return bumpy_plane(80, 10, 0.03); }, 0.0, 0.25, 0.25},
                      Classic{"BentCylinder", "bend-cylinder.json",
                              [] { return cylinder(32, 66, 0.5, 6.0); }, 120.0, 0.3, 0.1},
                      Classic{"TwistedBar", "twist-bar.json", [] { return bar(8, 48, 1.0, 6.0); },
                              135.0, 0.065, 0.1}),
    [](const auto& test) { return std::string(test.param.name); });

// Only its foot is held: the trunk and the other limb go where the bent limb takes them.
TEST(Cactus, BendsItsLimbWithoutFlipsFoldsOrLostDetail) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const Mesh cactus = read_mesh(test::models_folder() / "cgal/meshes/cactus.off");
  const Certificate c = certificate_of("bend-cactus.json", loop_subdivide(cactus));
  EXPECT_LT(c.settle_last_step, 0.01);
  EXPECT_EQ(c.flipped_triangles, 0U);
  EXPECT_GE(c.largest_rotation_degrees, 69.0);
  EXPECT_LT(c.detail_error, 0.1);
  EXPECT_LT(c.edge_stretch, 0.05);
}

}  // namespace
}  // namespace lapwing
