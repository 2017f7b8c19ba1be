// A person puts a part on a mesh in a real window, by real events.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/session/run_recipe.h"
#include "session/transplant_runs.h"
#include "support/gpu.h"
#include "viewer_window/person.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test::Desktop;
using test::Person;
using ::testing::IsEmpty;
using viewer::Draft;

// Pictures that differ by less than this do so by the words in the status line.
constexpr double kStatusLine = 0.7;

class Transplanting : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_DESKTOP();
    desktop_ = std::make_unique<Desktop>(folder_.path());
    person_ = std::make_unique<Person>(*desktop_, folder_.path());
    mesh_ = icosphere(5);
    write_mesh(mesh_, ball());
    fs::create_directories(person_->parts());
    write_mesh(test::finger(24, 20, 0.2, 0.6), person_->parts() / "finger.ply");
    person_->open(ball());
    ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
    desktop_->settled_picture();
    person_->look_from(View::front, mesh_.positions);
  }

  // Until the part shows there: it is read beside the window.
  bool carries_to(const Vector2d& pixel) {
    const Image before = desktop_->settled_picture();
    return test::eventually(90.0, [&] {
      person_->move_to(pixel + Vector2d(2.0, 0.0));
      person_->move_to(pixel);
      return test::mean_difference(desktop_->picture(), before) > 0.5;
    });
  }
  bool shows(const Image& picture) {
    return test::eventually(60.0, [&] {
      return test::mean_difference(desktop_->settled_picture(), picture) < kStatusLine;
    });
  }
  bool has_steps(std::size_t count) {
    return person_->eventually_is([&](const Draft& d) { return d.steps.size() == count; });
  }
  Vector3d part_place() const {
    const auto step = std::get<TransplantStep>(person_->draft().value().steps.at(0));
    return to_affine(std::get<Move>(step.place), Vector3d::Zero()).translation();
  }
  bool saves_as(const std::string& keys, const fs::path& path) {
    person_->open_dialog(keys);
    person_->type(path.string());
    person_->keys("Return");
    const bool saved = test::eventually(60.0, [&] { return fs::exists(path); });
    desktop_->settled_picture();
    return saved;
  }
  fs::path ball() const { return folder_ / "ball.ply"; }

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  std::unique_ptr<Person> person_;
  Mesh mesh_;
};

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
  EXPECT_TRUE(shows(opened));
  person_->keys("ctrl+shift+z");
  ASSERT_TRUE(has_steps(1));
  EXPECT_TRUE(shows(applied));

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
  EXPECT_EQ(person_->quit(), 0);
  EXPECT_THAT(person_->errors(), IsEmpty());

  CpuKernels kernels;
  const auto replayed = run_recipe(read_recipe(folder_ / "finger.json"), kernels);
  const Mesh saved = read_mesh(folder_ / "finger.ply");
  ASSERT_EQ(saved.face_vertices(), replayed->mesh.face_vertices());
  for (std::size_t v = 0; v < saved.vertex_count(); ++v) {
    EXPECT_LT((saved.positions[v] - replayed->mesh.positions[v]).norm(), 1e-5) << v;
  }
  test::expect_whole(*replayed);
}

}  // namespace
}  // namespace lapwing
