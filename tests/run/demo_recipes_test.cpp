// The four test motions of Botsch and Sorkine's survey, from the recipes of tools/classics, on
// coarser meshes of the same shapes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <span>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/doctor/self_intersections.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/run/run_recipe.h"
#include "run/transplant_runs.h"
#include "support/models.h"

namespace lapwing::test {
namespace {

namespace fs = std::filesystem;

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

// Returns the angles in degrees between the normals of adjacent triangles, in ascending order. If
// `counts` is not empty, includes only the edges between the vertices that `counts` marks.
std::vector<double> dihedral_angles(const Mesh& mesh, std::span<const char> counts = {}) {
  std::map<std::pair<Index, Index>, Eigen::Vector3d> normals;
  std::vector<double> angles;
  for (const Triangle& t : mesh.topology().triangles) {
    const Eigen::Vector3d a = mesh.positions[t[1]] - mesh.positions[t[0]];
    const Eigen::Vector3d b = mesh.positions[t[2]] - mesh.positions[t[0]];
    const Eigen::Vector3d normal = a.cross(b).stableNormalized();
    for (std::size_t k = 0; k < 3; ++k) {
      const Index low = std::min(t[k], t[(k + 1) % 3]);
      const Index high = std::max(t[k], t[(k + 1) % 3]);
      const auto [at, is_new] = normals.try_emplace({low, high}, normal);
      if (is_new || (!counts.empty() && (counts[low] == 0 || counts[high] == 0))) continue;
      angles.push_back(std::acos(std::clamp(at->second.dot(normal), -1.0, 1.0)) * 180.0 /
                       std::numbers::pi);
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

// Returns the percentile of ascending values. `share` is a fraction: 0.5 gives the median.
double percentile(const std::vector<double>& values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  return values[static_cast<std::size_t>(place)];
}

// The recipes that tools/transplants shows.
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
