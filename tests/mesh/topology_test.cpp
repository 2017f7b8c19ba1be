#include "lapwing/mesh/topology.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

TEST(Topology, RingHoldsNeighboursOfBothDirections) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  mesh.add_face(std::array<Index, 3>{2, 1, 3});
  const Topology& topology = mesh.topology();
  EXPECT_THAT(topology.rings[0], ElementsAre(1, 2));
  EXPECT_THAT(topology.rings[1], ElementsAre(0, 2, 3));
  EXPECT_THAT(topology.vertex_triangles[2], ElementsAre(0, 1));
}

TEST(Topology, RingsAreSymmetric) {
  const Topology topology = build_topology(icosphere(2));
  for (Index i = 0; i < topology.vertex_count(); ++i) {
    for (const Index j : topology.rings[i]) {
      EXPECT_THAT(topology.rings[j], ::testing::Contains(i));
    }
  }
}

TEST(SurfacePositions, LeaveOutIsolatedVertices) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {50, 50, 50}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(surface_positions(mesh.positions, mesh.topology()), mesh.positions) << "a point cloud";
  mesh.add_face(std::array<Index, 3>{0, 2, 3});
  EXPECT_EQ(surface_positions(mesh.positions, mesh.topology()),
            (Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(Topology, ClosedSurfacesHaveTheirEulerCharacteristic) {
  const auto euler = [](const Mesh& mesh) {
    const Topology& topology = mesh.topology();
    const auto edges = static_cast<long>(topology.rings.values.size() / 2);
    return static_cast<long>(mesh.vertex_count()) - edges +
           static_cast<long>(topology.triangles.size());
  };
  EXPECT_EQ(euler(icosphere(2)), 2);
  EXPECT_EQ(euler(torus(12, 8, 2.0, 0.5)), 0);
}

TEST(Topology, LooseVertexHasAnEmptyRingAndItsOwnComponent) {
  Mesh mesh = grid(2, 2);
  mesh.positions.emplace_back(5, 5, 5);
  const Topology& topology = mesh.topology();
  EXPECT_EQ(topology.rings.size(9), 0U);
  EXPECT_EQ(connected_components(topology.rings).count, 2U);
}

TEST(Topology, FaceThatNamesAMissingVertexIsRefusedByName) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 7});
  EXPECT_THAT(error_message<InputError>([&] { mesh.topology(); }),
              ::testing::AllOf(::testing::HasSubstr("face 0"), ::testing::HasSubstr("vertex 7")));
}

double signed_area(const Triangle& t, const Positions& p) {
  return 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z();
}

TEST(Triangulation, ConcavePolygonIsCutWithoutFolds) {
  const Positions arrow{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}};
  const std::array<Index, 4> polygon{0, 1, 2, 3};
  for (std::size_t turn = 0; turn < 4; ++turn) {
    std::array<Index, 4> turned = polygon;
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(turn), turned.end());
    std::vector<Triangle> triangles;
    triangulate_polygon(turned, arrow, triangles);
    ASSERT_EQ(triangles.size(), 2U);
    EXPECT_GT(signed_area(triangles[0], arrow), 0.0);
    EXPECT_GT(signed_area(triangles[1], arrow), 0.0);
    EXPECT_DOUBLE_EQ(signed_area(triangles[0], arrow) + signed_area(triangles[1], arrow), 1.5);
  }
}

TEST(Triangulation, PolygonBridgedToItsHoleIsCutWithoutFolds) {
  const Positions square_and_hole{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0},
                                  {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
  std::vector<Triangle> triangles;
  triangulate_polygon(std::array<Index, 10>{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}, square_and_hole,
                      triangles);
  double area = 0.0;
  for (const Triangle& t : triangles) {
    EXPECT_GE(signed_area(t, square_and_hole), 0.0);
    area += signed_area(t, square_and_hole);
  }
  EXPECT_DOUBLE_EQ(area, 8.0);
}

TEST(Triangulation, ConvexPolygonIsTheFanOfItsFirstCorner) {
  const Positions square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  std::vector<Triangle> triangles;
  triangulate_polygon(std::array<Index, 4>{0, 1, 2, 3}, square, triangles);
  EXPECT_THAT(triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(AllPlacesIn, ListsEachPlaceAscending) {
  const Adjacency places = inverse_lists(std::vector<Index>{2, 0, kNoIndex, 2, 3, 2}, 5);
  EXPECT_EQ(places.starts, (std::vector<Index>{0, 1, 1, 4, 5, 5}));
  EXPECT_EQ(places.values, (std::vector<Index>{1, 0, 3, 5, 4}));
}

TEST(WithRingNeighbours, ListsEachVertexOnce) {
  const Topology topology = build_topology(grid(2, 2));
  const std::vector<Index> corners{0, 1};
  const auto list = with_ring_neighbours(corners, topology.rings);
  EXPECT_TRUE(std::ranges::is_sorted(list, std::less_equal<Index>()));
  for (const Index v : corners) {
    EXPECT_TRUE(std::ranges::binary_search(list, v));
    for (const Index w : topology.rings[v]) EXPECT_TRUE(std::ranges::binary_search(list, w));
  }
  EXPECT_LT(list.size(), topology.vertex_count());
}

}  // namespace
}  // namespace lapwing
