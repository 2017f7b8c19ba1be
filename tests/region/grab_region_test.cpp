#include "lapwing/region/grab_region.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/geodesic.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// A vase about the z axis: a tube of radius 1 from z = 0 that widens to radius 6 beyond z = 20. The
// top is closed by a cap.
Mesh vase() {
  Mesh mesh = cylinder(64, 121, 1.0, 40.0);
  const double lowest =
      std::ranges::min(mesh.positions, {}, [](const Vector3d& p) { return p.z(); }).z();
  for (Vector3d& p : mesh.positions) {
    p.z() -= lowest;
    const double widened = std::clamp((p.z() - 20.0) / 4.0, 0.0, 1.0);
    p.head<2>() *= 1.0 + 5.0 * widened;
  }
  return mesh;
}

Index nearest_vertex(const Mesh& mesh, const Vector3d& point) {
  Index nearest = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const double distance = (mesh.positions[v] - point).squaredNorm();
    if (distance < (mesh.positions[nearest] - point).squaredNorm()) nearest = v;
  }
  return nearest;
}

GrabRegion grab(const Mesh& mesh, Index center, double brush, double factor = 1.0) {
  return grab_region(mesh.topology(), mesh.positions, center, brush, factor);
}

TEST(AGrab, OfALimbEndsWhereTheLimbJoinsTheBody) {
  const Mesh mesh = vase();
  const GrabRegion region = grab(mesh, nearest_vertex(mesh, {1.0, 0.0, 2.0}), 2.0);
  EXPECT_TRUE(region.is_limb);
  EXPECT_NEAR(region.radius, 18.0, 2.0);
}

TEST(AGrab, OfAFlatPlaceIsAMultipleOfTheBrush) {
  const Mesh mesh = grid(101, 101);
  const GrabRegion region = grab(mesh, nearest_vertex(mesh, {0.5, 0.5, 0.0}), 0.05);
  EXPECT_FALSE(region.is_limb);
  EXPECT_DOUBLE_EQ(region.radius, 0.15);
  EXPECT_THAT(region.cut_off, testing::IsEmpty());
  EXPECT_DOUBLE_EQ(grab(mesh, nearest_vertex(mesh, {0.5, 0.5, 0.0}), 0.05, 2.0).radius, 0.3);
}

TEST(AGrab, CoversAtMostHalfOfTheSurface) {
  const Mesh mesh = icosphere(4);
  const GrabRegion region = grab(mesh, 0, 2.0);
  EXPECT_NEAR(region.radius, 0.5 * std::numbers::pi, 0.1);
}

TEST(AGrab, InTheMiddleOfALimbTakesTheTipAlong) {
  const Mesh mesh = vase();
  const Index center = nearest_vertex(mesh, {1.0, 0.0, 15.0});
  const GrabRegion region = grab(mesh, center, 1.0);
  const std::vector<double> distances =
      geodesic_distances(mesh.topology(), mesh.positions, {&center, 1});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions[v].z() > 5.0) continue;
    const bool is_cut_off = std::ranges::binary_search(region.cut_off, v);
    EXPECT_TRUE(is_cut_off || distances[v] <= region.radius) << v;
    EXPECT_TRUE(std::ranges::binary_search(region.vertices, v)) << v;
  }
  for (const Index v : region.cut_off) EXPECT_LT(mesh.positions[v].z(), 15.0);
}

TEST(AGrab, CutsOffAnEndOfATubeOnlyIfTheOtherEndIsMuchLonger) {
  const Mesh tube = cylinder(64, 241, 1.0, 80.0);
  const double lowest =
      std::ranges::min(tube.positions, {}, [](const Vector3d& p) { return p.z(); }).z();
  for (const double height : {5.0, 12.0, 20.0, 35.0, 40.0}) {
    const Index center = nearest_vertex(tube, {1.0, 0.0, lowest + height});
    const GrabRegion region = grab(tube, center, 2.0);
    const double below = height - region.radius;
    const double above = 80.0 - height - region.radius;
    if (below > 1.0 && below < 0.45 * above) {
      EXPECT_THAT(region.cut_off, testing::Contains(nearest_vertex(tube, {1.0, 0.0, lowest})));
    } else if (below > 0.55 * above) {
      EXPECT_THAT(region.cut_off, testing::IsEmpty()) << height;
    }
  }
}

TEST(AGrab, OfARingCutsOffNothing) {
  const Mesh ring = torus(192, 24, 8.0, 1.0);
  for (const double factor : {0.5, 1.0, 2.0, 4.0}) {
    EXPECT_THAT(grab(ring, 0, 1.0, factor).cut_off, testing::IsEmpty()) << factor;
  }
}

TEST(AGrab, RefusesWhatIsNotASurfaceOrASize) {
  Mesh mesh = grid(3, 3);
  mesh.positions.emplace_back(9.0, 9.0, 9.0);
  EXPECT_THROW(grab(mesh, static_cast<Index>(mesh.vertex_count() - 1), 0.1), InputError);
  EXPECT_THROW(grab(mesh, 99, 0.1), InputError);
  EXPECT_THROW(grab(mesh, 0, 0.0), InputError);
  EXPECT_THROW(grab(mesh, 0, std::numeric_limits<double>::infinity()), InputError);
  EXPECT_THROW(grab(mesh, 0, 0.1, -1.0), InputError);
}

TEST(AGrabOfTheArmadillo, EndsWhereItsLimbsEnd) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  const auto file = std::ranges::find(files, "armadillo.off",
                                      [](const auto& path) { return path.filename().string(); });
  ASSERT_NE(file, files.end());
  const Mesh mesh = read_mesh(*file);
  const auto at_most = [&](auto key) {
    Index best = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (key(mesh.positions[v]) > key(mesh.positions[best])) best = v;
    }
    return best;
  };
  const Index ear = at_most([](const Vector3d& p) { return p.y(); });
  const Index foot = at_most([](const Vector3d& p) { return -p.y() - 0.3 * p.x(); });
  const Index tail = at_most([](const Vector3d& p) { return p.z(); });
  const Index belly = nearest_vertex(mesh, {0.0, 35.0, -20.0});
  // Lengths are those at which the circles around these places open.
  EXPECT_NEAR(grab(mesh, 969, 8.0).radius, 75.0, 10.0);
  EXPECT_NEAR(grab(mesh, ear, 8.0).radius, 28.0, 8.0);
  EXPECT_NEAR(grab(mesh, foot, 12.0).radius, 100.0, 15.0);
  EXPECT_NEAR(grab(mesh, tail, 8.0).radius, 42.0, 8.0);
  EXPECT_DOUBLE_EQ(grab(mesh, belly, 8.0).radius, 24.0);
}

}  // namespace
}  // namespace lapwing
