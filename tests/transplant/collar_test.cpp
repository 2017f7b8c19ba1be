#include "lapwing/transplant/collar.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/geodesic.h"
#include "support/error_message.h"
#include "transplant/loops.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Piece {
  Mesh mesh;
  Topology topology;
  BoundaryLoop seam;
  std::vector<double> distances;
};

Piece piece(Mesh mesh) {
  Piece result{std::move(mesh), {}, {}, {}};
  result.topology = result.mesh.topology();
  result.seam = boundary_loops(result.topology.triangles, "piece").front();
  result.distances = geodesic_distances(result.topology, result.mesh.positions, result.seam);
  return result;
}

Collar collar_of(const Piece& piece, double width) {
  return make_collar(piece.topology.triangles, piece.seam, piece.distances, width, "test");
}

TEST(Collar, IsAnAnnulusBetweenItsLoops) {
  const Piece square = piece(grid(20, 20));
  for (const double width : {1e-6, 0.1, 0.2, 0.35}) {
    const Collar collar = collar_of(square, width);
    const auto loops = boundary_loops(collar.triangles, "collar");
    ASSERT_EQ(loops.size(), 2U) << width;
    EXPECT_EQ(collar.seam, square.seam);
    EXPECT_THAT(loops, ::testing::Contains(collar.inner));
    // Every vertex nearer than the width is inside, with all of its triangles.
    for (const Index v : collar.inner) EXPECT_GE(square.distances[v], width);
  }
}

TEST(Collar, FillsWhatTheOffsetWouldCutOff) {
  // A hill within the width: its top is farther from the seam than the width along the surface.
  Mesh hill = grid(60, 60);
  for (Eigen::Vector3d& p : hill.positions) {
    const double r = (p.head<2>() - Eigen::Vector2d(0.12, 0.5)).norm();
    p.z() = r < 0.08 ? 0.3 * (1.0 - r / 0.08) : 0.0;
  }
  const Piece square = piece(hill);
  const Collar collar = collar_of(square, 0.25);
  EXPECT_EQ(boundary_loops(collar.triangles, "collar").size(), 2U);
}

TEST(Collar, IsEmptyWhereNothingIsLeftBeyond) {
  EXPECT_THAT(collar_of(piece(grid(20, 20)), 0.6).triangles, IsEmpty());
}

TEST(Collar, NamesAnotherBoundaryWithinItsWidth) {
  const Piece pierced = piece(test::with_hole(grid(40, 40), {0.2, 0.5, 0.0}, 0.05));
  EXPECT_THAT(error_message<InputError>([&] { collar_of(pierced, 0.3); }),
              HasSubstr("another boundary"));
  EXPECT_EQ(boundary_loops(collar_of(pierced, 0.1).triangles, "collar").size(), 2U);
}

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
