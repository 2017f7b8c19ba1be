#include "lapwing/render/ground_grid.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "render/picture.h"
#include "support/gpu.h"
#include "support/keep_picture.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::Subject;

Bounds cube(double side) {
  return {Vector3d::Zero(), Vector3d::Constant(side)};
}

TEST(GroundGrid, SpacingIsOneTwoOrFiveTimesAPowerOfTen) {
  for (double side = 1e-37; side < 1e37; side *= 1.7) {
    const double spacing = ground_grid(cube(side), UpAxis::y).spacing;
    const double tenth = 0.1 * std::sqrt(3.0) * side;
    EXPECT_LE(spacing, tenth * (1.0 + 1e-12));
    EXPECT_GT(spacing, 0.4 * tenth * (1.0 - 1e-12));
    const double digits = spacing / std::pow(10.0, std::floor(std::log10(spacing) + 1e-9));
    EXPECT_TRUE(std::abs(digits - 1.0) < 1e-9 || std::abs(digits - 2.0) < 1e-9 ||
                std::abs(digits - 5.0) < 1e-9)
        << digits;
  }
}

TEST(GroundGrid, LiesUnderTheMeshWithItsLinesAtMultiplesOfTheSpacing) {
  const Bounds bounds{Vector3d(3.1, 4.2, 5.3), Vector3d(13.0, 14.0, 15.0)};
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    const GroundGrid grid = ground_grid(bounds, up);
    const Eigen::Index axis = up == UpAxis::y ? 1 : 2;
    EXPECT_LT(grid.center[axis], bounds.min[axis]);
    EXPECT_NEAR(grid.center[axis], bounds.min[axis], 1e-3 * bounds.diagonal());
    for (const Eigen::Index across : {Eigen::Index{0}, Eigen::Index{3 - axis}}) {
      const double lines = grid.center[across] / grid.spacing;
      EXPECT_NEAR(lines, std::round(lines), 1e-9);
      EXPECT_LT(grid.bounds().min[across], bounds.min[across]);
      EXPECT_GT(grid.bounds().max[across], bounds.max[across]);
    }
  }
}

TEST(GroundGrid, OfAPointIsThatOfASizeOfOne) {
  EXPECT_EQ(ground_grid({Vector3d::Ones(), Vector3d::Ones()}, UpAxis::y).spacing, 0.1);
}

// The sphere hides the grid under it. Beside the sphere, the grid has lines and gaps.
TEST(GroundGrid, IsDrawnBehindTheMesh) {
  LAPWING_NEEDS_GPU();
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    Subject sphere(icosphere(4));
    sphere.options.width = sphere.options.height = 400;
    sphere.options.background = Background::white;
    sphere.camera =
        fit(sphere.mesh.positions, view_axes(View::three_quarter, up), 1.0, {.margin = 0.3});
    const Image without = sphere.render();
    sphere.options.grid = ground_grid(bounds_of(sphere.mesh.positions), up);
    fit_depth(sphere.camera, sphere.options.grid->bounds());
    const Image with = sphere.render();
    test::keep_picture(with, up == UpAxis::y ? "ground-grid-y" : "ground-grid-z");
    EXPECT_EQ(with.pixel(200, 180), without.pixel(200, 180));
    std::size_t changed = 0;
    for (std::uint32_t x = 0; x < with.width; ++x) {
      if (with.pixel(x, 370) != without.pixel(x, 370)) ++changed;
    }
    EXPECT_GT(changed, 5U);
    EXPECT_LT(changed, 300U);
  }
}

}  // namespace
}  // namespace lapwing
