#include "lapwing/transplant/mapped_collar.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::IsEmpty;

Collar collar_of(const Mesh& mesh, double width) {
  const Topology& topology = mesh.topology();
  const BoundaryLoop seam = boundary_loops(topology.triangles, "piece").front();
  return make_collar(topology.triangles, seam, geodesic_distances(topology, mesh.positions, seam),
                     width, "test");
}

MappedCollar lay(const Collar& collar, const Mesh& mesh) {
  return map_collar(collar, mesh.positions, best_cut(collar, mesh.positions), "test");
}

TEST(MappedCollar, CoversTheSquareWithoutAFlippedTriangle) {
  const Mesh mesh = bumpy_plane(24, 4, 0.1);
  const MappedCollar laid = lay(collar_of(mesh, 0.2), mesh);
  EXPECT_THAT(flipped_triangles(laid.patch.triangles, laid.map.points), IsEmpty());
  double area = 0.0;
  for (const Triangle& t : laid.patch.triangles) {
    const Eigen::Vector2d a = laid.map.points[t[1]] - laid.map.points[t[0]];
    const Eigen::Vector2d b = laid.map.points[t[2]] - laid.map.points[t[0]];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_NEAR(area, 1.0, 1e-9);
}

TEST(MappedCollar, HasTheSeamBelowTheInnerLoopAboveAndTheCutOnBothSides) {
  const Mesh mesh = bumpy_plane(24, 4, 0.1);
  const Collar collar = collar_of(mesh, 0.2);
  const MappedCollar laid = lay(collar, mesh);
  std::vector<std::vector<Eigen::Vector2d>> places(mesh.vertex_count());
  for (std::size_t own = 0; own < laid.vertices.size(); ++own) {
    places[laid.vertices[own]].push_back(laid.map.points[own]);
  }
  for (const Index v : collar.seam) EXPECT_NEAR(places[v][0].y(), 0.0, 1e-12);
  for (const Index v : collar.inner) EXPECT_NEAR(places[v][0].y(), 1.0, 1e-12);
  for (const Index v : laid.cut) {
    ASSERT_EQ(places[v].size(), 2U);
    EXPECT_NEAR(places[v][0].y(), places[v][1].y(), 1e-12);
    EXPECT_NEAR(std::abs(places[v][0].x() - places[v][1].x()), 1.0, 1e-12);
  }
  EXPECT_EQ(
      laid.cut.size() + collar.seam.size() + collar.inner.size() - 2U,
      static_cast<std::size_t>(std::count_if(places.begin(), places.end(), [](const auto& list) {
        return !list.empty() &&
               (list.size() == 2 || list[0].y() < 1e-12 || list[0].y() > 1.0 - 1e-12);
      })));
}

TEST(MappedCollar, LiesOnItselfVertexOnVertex) {
  const Mesh mesh = bumpy_plane(24, 4, 0.1);
  const MappedCollar laid = lay(collar_of(mesh, 0.2), mesh);
  const auto points = lay_on(laid, laid, mesh.vertex_count());
  std::vector<char> on_collar(mesh.vertex_count(), 0);
  for (const Index v : laid.vertices) on_collar[v] = 1;
  for (Index v = 0; v < points.size(); ++v) {
    EXPECT_EQ(points[v].is_nowhere(), on_collar[v] == 0);
    if (on_collar[v] == 0) continue;
    EXPECT_LT((points[v].of<Vector3d>(mesh.positions) - mesh.positions[v]).norm(), 1e-9) << v;
  }
}

TEST(MappedCollar, LiesOnAFinerOneOfTheSameSeamCloseToItself) {
  // The same flat collar, with other triangles inside.
  const Mesh coarse = grid(20, 20);
  Mesh bent = coarse;
  for (Vector3d& p : bent.positions) {
    const double inside = p.x() * (1.0 - p.x()) * p.y() * (1.0 - p.y());
    p.x() += 0.3 * inside;
  }
  const Collar below = collar_of(coarse, 0.22);
  const Collar above = collar_of(bent, 0.22);
  const Index start = best_cut(below, coarse.positions);
  const auto points =
      lay_on(map_collar(above, bent.positions, start, "test"),
             map_collar(below, coarse.positions, start, "test"), bent.vertex_count());
  for (Index v = 0; v < points.size(); ++v) {
    if (points[v].is_nowhere()) continue;
    EXPECT_LT((points[v].of<Vector3d>(coarse.positions) - bent.positions[v]).norm(), 0.05) << v;
  }
}

TEST(MappedCollar, CannotBeCutFromAVertexOffTheSeam) {
  const Mesh mesh = grid(20, 20);
  const Collar collar = collar_of(mesh, 0.2);
  EXPECT_THROW(map_collar(collar, mesh.positions, 10 * 21 + 10, "test"), InputError);
}

}  // namespace
}  // namespace lapwing
