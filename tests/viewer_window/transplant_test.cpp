// A person puts a part on a mesh in a real window, by real events.
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/run/run_recipe.h"
#include "support/largest_distance.h"
#include "viewer_window/transplant_window.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Pictures that differ by less than this do so by the words in the status line.
constexpr double kStatusLine = 0.7;

TEST_F(Transplanting, ByHandIsUndoneRedoneTakenUpAgainAndEqualToItsRecipe) {
  const Vector3d left = Vector3d(-0.4, 0.2, 0.9).normalized();
  const Vector3d right = Vector3d(0.5, 0.1, 0.85).normalized();
  const Image opened = desktop_->settled_picture();
  person_->keys("n");
  ASSERT_TRUE(carries_to(person_->pixel_of(left)));
  person_->scroll(person_->pixel_of(left), 2, "ctrl");
  person_->click(person_->pixel_of(left));
  person_->keys("Return");
  ASSERT_TRUE(has_steps(1));
  EXPECT_LT((part_place() - left).norm(), 0.05);
  const Image applied = desktop_->settled_picture();
  ASSERT_GT(test::mean_difference(applied, opened), 2.0 * kStatusLine);

  person_->keys("ctrl+z");
  ASSERT_TRUE(has_steps(0));
  EXPECT_TRUE(shows(opened, kStatusLine));
  person_->keys("ctrl+shift+z");
  ASSERT_TRUE(has_steps(1));
  EXPECT_TRUE(shows(applied, kStatusLine));

  person_->keys("shift+n");
  desktop_->settled_picture();
  ASSERT_TRUE(test::eventually(60.0, [&] {
    // Carried as soon as it is there.
    person_->keys("g");
    person_->move_to(person_->pixel_of(right));
    return test::mean_difference(desktop_->settled_picture(), applied) > 0.5;
  }));
  person_->click(person_->pixel_of(right));
  person_->keys("Return");
  ASSERT_TRUE(test::eventually(60.0, [&] { return (part_place() - right).norm() < 0.05; }));
  EXPECT_EQ(person_->draft()->steps.size(), 1U) << "the same step, somewhere else";

  person_->keys("n");
  ASSERT_TRUE(carries_to(person_->pixel_of(left)));
  person_->keys("Escape");
  desktop_->settled_picture();
  EXPECT_EQ(person_->draft()->steps.size(), 1U) << "given up";

  ASSERT_TRUE(saves_as("ctrl+e", folder_ / "finger.json"));
  ASSERT_TRUE(saves_as("ctrl+shift+s", folder_ / "finger.ply"));
  expect_quits_silently();

  CpuKernels kernels;
  const auto replayed = run_recipe(read_recipe(folder_ / "finger.json"), kernels);
  const Mesh saved = read_mesh(folder_ / "finger.ply");
  ASSERT_EQ(saved.face_vertices(), replayed->mesh.face_vertices());
  EXPECT_LT(test::largest_distance(saved.positions, replayed->mesh.positions), 1e-5);
  test::expect_whole(*replayed);
}

}  // namespace
}  // namespace lapwing
