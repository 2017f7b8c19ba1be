// A head with a hat and beads that are no part of its surface, dragged in a real window.
#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/io/point_table.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/run/run_recipe.h"
#include "support/cap.h"
#include "support/gpu.h"
#include "support/largest_distance.h"
#include "support/models.h"
#include "viewer_window/window_test.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using viewer::Draft;
using viewer::GizmoMode;
using viewer::GizmoPart;

// Of the pixels in the colour of what is carried.
struct Spot {
  std::size_t count = 0;
  Vector2d middle = Vector2d::Zero();
};

Spot carried_in(const Image& picture) {
  // Between blue and yellow, which regions have.
  constexpr int kGreener = 20;
  Spot spot;
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const auto pixel = picture.pixel(x, y);
      const int above_red = pixel[1] - pixel[0];
      const int above_blue = pixel[1] - pixel[2];
      if (above_red < kGreener || above_blue < 0 || above_blue > above_red) continue;
      ++spot.count;
      spot.middle += Vector2d(x, y);
    }
  }
  if (spot.count > 0) spot.middle /= static_cast<double>(spot.count);
  return spot;
}

// head.off looks along -x, its neck ends at y = 0, its crown at y = 17.
class CarryingInAWindow : public test::WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    LAPWING_NEEDS_MODELS(files, "cgal");
    write_mesh(read_mesh(test::models_folder() / "cgal/meshes/head.off"), folder_ / "head.obj");
    head_ = read_mesh(folder_ / "head.obj");
    const double away = 0.02 * bounds_of(head_.positions).diagonal();
    write_mesh(test::cap_of(head_, 13.0, away, Vector3d(0, 12, 0)), folder_ / "hat.obj");
    std::ofstream beads(folder_ / "beads.csv");
    beads << "x,y,z\n";
    constexpr int kBeads = 24;
    for (int k = 0; k < kBeads; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kBeads;
      beads << 7.0 * std::cos(angle) << "," << 9.0 << "," << 7.0 * std::sin(angle) << "\n";
    }
    beads.close();
    // The neck is held, the crown is the handle.
    std::ofstream(folder_ / "head.json") << R"({"lapwing": 1, "mesh": "head.obj", "steps": [
        {"op": "deform", "roi": {"all": true},
         "belt": {"box": {"min": [-20, -1, -20], "max": [20, 3, 20]}},
         "handles": [{"region": {"box": {"min": [-20, 14, -20], "max": [20, 20, 20]}},
                      "move": {"translate": [0, 0, 0]}}], "carry": ["hat.obj"]}]})";
    person_->open(folder_ / "head.json", {"--carry", (folder_ / "beads.csv").string()});
    ASSERT_TRUE(person_->waits_for_window()) << person_->errors();
    desktop_->settled_picture();
    Positions all = head_.positions;
    for (const char* name : {"hat.obj", "beads.csv"}) {
      const Positions more = positions_in(folder_ / name);
      all.insert(all.end(), more.begin(), more.end());
    }
    person_->look_from(View::front, all);
  }

  static Positions positions_in(const fs::path& path) {
    return path.extension() == ".csv" ? read_point_table(path).positions
                                      : read_mesh(path).positions;
  }
  viewer::Gizmo gizmo() const {
    const VertexSet handle = resolve(person_->draft().value().open.handles.at(0).region, head_);
    Vector3d centroid = Vector3d::Zero();
    for (const Index v : handle) {
      centroid += head_.positions[v] / static_cast<double>(handle.size());
    }
    return {GizmoMode::translate, centroid};
  }

  Mesh head_;
};

TEST_F(CarryingInAWindow, WhatIsCarriedFollowsTheHandAndIsSavedAsInARun) {
  const Spot opened = carried_in(desktop_->settled_picture());
  ASSERT_GT(opened.count, 20000U);
  const Vector2d from = test::middle_of(gizmo(), GizmoPart::x, person_->projection());
  const Vector2d by(140.0, 0.0);
  person_->hold({from, from + 0.4 * by, from + by});
  EXPECT_TRUE(test::eventually(30.0, [&] {
    return carried_in(desktop_->picture()).middle.x() - opened.middle.x() > 0.5 * by.x();
  })) << "while it is dragged";
  person_->let_go();
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return d.settled; }));
  const Spot dragged = carried_in(desktop_->settled_picture());
  EXPECT_GT(dragged.middle.x() - opened.middle.x(), 0.5 * by.x());
  ASSERT_EQ(person_->draft()->open.carry.size(), 2U);

  ASSERT_TRUE(saves_as("ctrl+e", folder_ / "lean.json"));
  ASSERT_TRUE(saves_as("ctrl+shift+s", folder_ / "leaning.obj"));
  person_->keys("ctrl+z ctrl+z");
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return !d.settled; }));
  EXPECT_NEAR(carried_in(desktop_->settled_picture()).middle.x(), opened.middle.x(), 8.0);
  person_->keys("ctrl+y ctrl+y");
  ASSERT_TRUE(person_->eventually_is([](const Draft& d) { return d.settled; }));
  EXPECT_NEAR(carried_in(desktop_->settled_picture()).middle.x(), dragged.middle.x(), 1.0);
  expect_quits_silently();

  CpuKernels kernels;
  const auto run = run_recipe(read_recipe(folder_ / "lean.json"), kernels);
  ASSERT_EQ(run->carried.size(), 2U);
  for (const AttachmentFile& file : run->carried) {
    const fs::path saved = file.target(folder_ / "leaning.obj");
    // A drag settles from what it has shown, to the tolerance of settling.
    EXPECT_LT(test::largest_distance(positions_in(saved), file.positions()), 1e-4) << saved;
  }
}

}  // namespace
}  // namespace lapwing
