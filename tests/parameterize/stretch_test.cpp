#include "lapwing/parameterize/stretch.h"

#include <gtest/gtest.h>

#include "parameterize/test_patches.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

MapDistortion of_grid_scaled(double x, double y) {
  const Mesh mesh = test::moved(grid(5, 7));
  std::vector<Vector2d> points;
  for (const Vector3d& p : grid(5, 7).positions) points.emplace_back(x * p.x(), y * p.y());
  return measure_distortion(mesh.topology().triangles, mesh.positions, points);
}

TEST(MapDistortion, IsOneForSimilarities) {
  for (const double scale : {1.0, 0.01, 300.0}) {
    const MapDistortion distortion = of_grid_scaled(scale, -scale);
    EXPECT_NEAR(distortion.stretch, 1.0, 1e-10);
    EXPECT_NEAR(distortion.largest_stretch, 1.0, 1e-10);
    EXPECT_NEAR(distortion.largest_shear, 1.0, 1e-4) << "the root of a rounding error";
  }
}

// Lengths grow by 1/2 and by 1, areas by 1/2: stretch sqrt((1/4 + 1) / 2) / sqrt(1/2).
TEST(MapDistortion, OfAnEvenStretchIsThatOfTheFormula) {
  const MapDistortion distortion = of_grid_scaled(2.0, 1.0);
  EXPECT_NEAR(distortion.stretch, std::sqrt(1.25), 1e-9);
  EXPECT_NEAR(distortion.largest_stretch, std::sqrt(1.25), 1e-9);
  EXPECT_NEAR(distortion.shear, 2.0, 1e-9);
  EXPECT_NEAR(distortion.largest_shear, 2.0, 1e-9);
}

TEST(MapDistortion, LeavesOutWhatHasNoArea) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {1, 3, 2}};
  const std::vector<Vector3d> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::vector<Vector2d> points{{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}};
  const MapDistortion distortion = measure_distortion(triangles, positions, points);
  EXPECT_NEAR(distortion.stretch, 1.0, 1e-12);
  EXPECT_EQ(measure_distortion({}, {}, {}).stretch, 1.0);
}

}  // namespace
}  // namespace lapwing
