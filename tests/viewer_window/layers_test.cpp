// A person coats and mixes in a real window, by real events.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/kernels/cpu_kernels.h"
#include "support/gpu.h"
#include "support/largest_distance.h"
#include "viewer_state/sheet_edit.h"
#include "viewer_window/person.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using test::Desktop;
using test::Person;
using viewer::Draft;

// The source takes the left half of the window once the panels are hidden.
constexpr double kSourceWidth = 640.0;
constexpr double kSourceHeight = 800.0;

class Layers : public ::testing::Test {
 protected:
  void SetUp() override {
    LAPWING_NEEDS_DESKTOP();
    desktop_ = std::make_unique<Desktop>(folder_.path());
    person_ = std::make_unique<Person>(*desktop_, folder_.path());
    sheet_ = read_mesh(files_.sheet());
    relief_ = read_mesh(files_.relief());
    person_->open(files_.sheet());
    ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
    desktop_->settled_picture();
    person_->look_from(View::front, sheet_.positions);
  }

  // A disk around the middle becomes the ROI, which is the target patch.
  void choose_target() {
    person_->keys("d");
    person_->keys("i");
    const Vector2d middle = person_->pixel_of({0.5, 0.5, 0.025});
    const Vector2d rim = person_->pixel_of({0.85, 0.5, 0.07});
    person_->drag({middle, 0.5 * (middle + rim), rim});
    ASSERT_TRUE(person_->eventually_is(
        [](const Draft& d) { return std::holds_alternative<GeodesicDisk>(d.open.roi.form); }));
  }

  // Begins with these keys; the source is beside the mesh then.
  void begin(const std::string& keys) {
    const Image before = desktop_->settled_picture();
    person_->keys(keys);
    EXPECT_TRUE(test::eventually(
        60.0, [&] { return test::mean_difference(desktop_->picture(), before) > 1.0; }));
    desktop_->settled_picture();
  }

  void take_from_relief() {
    person_->open_dialog("ctrl+shift+k");
    person_->type(files_.relief().string());
    const Image before = desktop_->settled_picture();
    person_->keys("Return");
    EXPECT_TRUE(test::eventually(
        60.0, [&] { return test::mean_difference(desktop_->picture(), before) > 1.0; }));
    desktop_->settled_picture();
  }

  // Where a place of the source shows.
  static Vector2d source_pixel(const Mesh& source, const Vector3d& place) {
    const Camera camera =
        fit(source.positions, view_axes(View::three_quarter), kSourceWidth / kSourceHeight);
    const viewer::Projection projection{
        camera.projection(kSourceWidth / kSourceHeight) * camera.view(),
        {kSourceWidth, kSourceHeight}};
    return projection.to_pixel(place).value();
  }

  void choose_source(const Mesh& source) {
    const Vector2d middle = source_pixel(source, {0.5, 0.5, 0.02});
    const Vector2d rim = source_pixel(source, {0.85, 0.5, 0.05});
    person_->drag({middle, 0.5 * (middle + rim), rim});
    desktop_->settled_picture();
  }

  // Applies it, and takes it back and forth.
  void apply_undo_and_redo() {
    const auto steps_are = [&](std::size_t count) {
      return person_->eventually_is([&](const Draft& d) { return d.steps.size() == count; });
    };
    person_->keys("ctrl+Return");
    ASSERT_TRUE(steps_are(1));
    desktop_->settled_picture();
    person_->keys("ctrl+z");
    ASSERT_TRUE(steps_are(0));
    person_->keys("ctrl+shift+z");
    ASSERT_TRUE(steps_are(1));
  }

  bool save_as(const std::string& keys, const fs::path& path) {
    person_->open_dialog(keys);
    person_->type(path.string());
    person_->keys("Return");
    const bool saved = test::eventually(60.0, [&] { return fs::exists(path); });
    desktop_->settled_picture();
    return saved;
  }

  // What was saved, mesh and recipe, is the same surface.
  void expect_is_its_recipe() {
    const fs::path recipe = folder_.path() / "by-hand.json";
    const fs::path mesh = folder_.path() / "by-hand.ply";
    ASSERT_TRUE(save_as("ctrl+e", recipe));
    ASSERT_TRUE(save_as("ctrl+shift+s", mesh));
    EXPECT_EQ(person_->quit(), 0);
    CpuKernels kernels;
    const Mesh replayed = run_recipe(read_recipe(recipe), kernels)->mesh;
    const Mesh saved = read_mesh(mesh);
    ASSERT_EQ(saved.vertex_count(), replayed.vertex_count());
    EXPECT_EQ(saved.face_vertices(), replayed.face_vertices());
    EXPECT_LT(test::largest_distance(saved.positions, replayed.positions), 1e-5);
    EXPECT_NE(saved.positions, sheet_.positions);
  }

  viewer::test::SheetAndRelief files_;
  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  std::unique_ptr<Person> person_;
  Mesh sheet_;
  Mesh relief_;
};

TEST_F(Layers, ACoatDoneByHandIsItsRecipe) {
  choose_target();
  begin("ctrl+k");
  take_from_relief();
  choose_source(relief_);
  // The same place on both, side by side.
  person_->keys("k");
  person_->look_again_from(View::front, sheet_.positions, 0.5);
  person_->click(source_pixel(relief_, {0.5, 0.6, 0.0}));
  person_->click(person_->pixel_of({0.45, 0.55, 0.02}));
  desktop_->settled_picture();
  person_->keys("k");
  apply_undo_and_redo();
  const auto coat = std::get<CoatStep>(person_->draft()->steps.at(0));
  EXPECT_EQ(coat.source.mesh, files_.relief());
  EXPECT_TRUE(std::holds_alternative<GeodesicDisk>(coat.source.patch.form));
  ASSERT_EQ(coat.source.inner_pairs.size(), 1U);
  const auto [source, target] = coat.source.inner_pairs[0];
  EXPECT_LT((relief_.positions[source] - Vector3d(0.5, 0.6, 0.0)).norm(), 0.06);
  EXPECT_LT((sheet_.positions[target] - Vector3d(0.45, 0.55, 0.02)).norm(), 0.1);
  expect_is_its_recipe();
}

TEST_F(Layers, AMixDoneByHandIsItsRecipe) {
  choose_target();
  begin("ctrl+m");
  take_from_relief();
  choose_source(relief_);
  person_->keys("shift+k");
  desktop_->settled_picture();
  choose_source(sheet_);
  apply_undo_and_redo();
  const auto mix = std::get<MixStep>(person_->draft()->steps.at(0));
  EXPECT_EQ(mix.sources[0].mesh, files_.relief());
  EXPECT_TRUE(mix.sources[1].mesh.empty()) << "the mesh itself";
  expect_is_its_recipe();
}

}  // namespace
}  // namespace lapwing
