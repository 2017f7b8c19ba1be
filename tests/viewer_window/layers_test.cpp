// Tests coating in a real window, with real input events.
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/run/run_recipe.h"
#include "support/largest_distance.h"
#include "viewer_window/layers_window.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

TEST_F(Layers, ACoatDoneByHandIsItsRecipe) {
  choose_target();
  choose_coat();
  // The same place on both, side by side.
  person_->keys("k");
  person_->look_again_from(View::front, sheet_.positions, 0.5);
  person_->click(source_pixel(relief_, {0.5, 0.6, 0.0}));
  person_->click(person_->pixel_of({0.45, 0.55, 0.02}));
  desktop_->settled_picture();
  person_->keys("k ctrl+Return");
  ASSERT_TRUE(has_steps(1));
  desktop_->settled_picture();
  person_->keys("ctrl+z");
  ASSERT_TRUE(has_steps(0));
  person_->keys("ctrl+shift+z");
  ASSERT_TRUE(has_steps(1));
  const auto coat = std::get<CoatStep>(person_->draft()->steps.at(0));
  EXPECT_EQ(coat.source.mesh, files_.relief());
  EXPECT_TRUE(std::holds_alternative<GeodesicDisk>(coat.source.patch.form));
  ASSERT_EQ(coat.source.inner_pairs.size(), 1U);
  const auto [source, target] = coat.source.inner_pairs[0];
  EXPECT_LT((relief_.positions[source] - Vector3d(0.5, 0.6, 0.0)).norm(), 0.06);
  EXPECT_LT((sheet_.positions[target] - Vector3d(0.45, 0.55, 0.02)).norm(), 0.1);

  const fs::path recipe = folder_ / "by-hand.json";
  const fs::path mesh = folder_ / "by-hand.ply";
  ASSERT_TRUE(saves_as("ctrl+e", recipe));
  ASSERT_TRUE(saves_as("ctrl+shift+s", mesh));
  expect_quits_silently();
  CpuKernels kernels;
  const Mesh replayed = run_recipe(read_recipe(recipe), kernels)->mesh;
  const Mesh saved = read_mesh(mesh);
  ASSERT_EQ(saved.vertex_count(), replayed.vertex_count());
  EXPECT_EQ(saved.face_vertices(), replayed.face_vertices());
  EXPECT_LT(test::largest_distance(saved.positions, replayed.positions), 1e-5);
  EXPECT_NE(saved.positions, sheet_.positions);
}

}  // namespace
}  // namespace lapwing
