#include "lapwing/mesh/seams.h"

#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "lapwing/mesh/welder.h"
#include "support/split_meshes.h"

namespace lapwing {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(FirstAtSamePosition, NamesTheFirstOfEqualPositions) {
  const Positions positions{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {3, 2, 1}, {1, 2, 3}};
  EXPECT_THAT(first_at_same_position(positions), ElementsAre(0, 1, 0, 3, 0));
}

TEST(FirstAtSamePosition, ComparesExactlyButForTheSignOfZero) {
  const double near_one = 1.0 + std::numeric_limits<double>::epsilon();
  const Positions positions{{0, 1, 0}, {-0.0, 1, 0}, {0, near_one, 0}};
  EXPECT_THAT(first_at_same_position(positions), ElementsAre(0, 0, 2));
}

TEST(FirstAtSamePosition, NonFinitePositionsEqualNothing) {
  const double inf = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Positions positions{{inf, 0, 0}, {inf, 0, 0}, {nan, 0, 0}, {nan, 0, 0}};
  EXPECT_THAT(first_at_same_position(positions), ElementsAre(0, 1, 2, 3));
}

TEST(FirstAtSamePosition, ManyCopiesOfOnePointAreOneGroup) {
  EXPECT_THAT(first_at_same_position(Positions(10000, Eigen::Vector3d(1, 1, 1))), Each(0U));
}

void add_polygon(Mesh& mesh, std::initializer_list<Index> vertices) {
  mesh.add_face(std::span(vertices.begin(), vertices.size()));
}

// Every face of the joined surface is that of the mesh, and no vertex of it has two leaders.
void expect_joined_as(const JoinedSurface& joined, const test::SplitMesh& split, const Mesh& mesh) {
  std::set<std::pair<Index, Index>> leaders;
  for (Index v = 0; v < split.sources.size(); ++v) {
    leaders.insert({split.sources[v], joined.leaders[v]});
    EXPECT_EQ(split.sources[joined.leaders[v]], split.sources[v]);
  }
  EXPECT_EQ(leaders.size(), mesh.vertex_count());
  ASSERT_EQ(joined.surface.face_vertices().size(), mesh.face_vertices().size());
  for (std::size_t c = 0; c < mesh.face_vertices().size(); ++c) {
    EXPECT_EQ(split.sources[joined.surface.face_vertices()[c]], mesh.face_vertices()[c]);
  }
}

TEST(JoinedSurface, OfAMeshWithoutSeamsIsEmpty) {
  for (const NamedShape& shape : named_shapes()) {
    EXPECT_TRUE(joined_surface(shape.make()).empty()) << shape.name;
  }
  EXPECT_TRUE(joined_surface(Mesh()).empty());
}

TEST(JoinedSurface, OfASoupIsTheMeshThatItWasCutFrom) {
  for (const Mesh& mesh : {grid(5, 4), icosphere(1), cylinder(6, 4, 0.5, 1.0)}) {
    const test::SplitMesh split = test::soup(mesh);
    expect_joined_as(joined_surface(split.mesh), split, mesh);
  }
}

TEST(JoinedSurface, OfAMeshInTwoChartsKeepsTheNumbersOfTheFirst) {
  const Mesh mesh = icosphere(2);
  const test::SplitMesh split = test::halves(mesh);
  const JoinedSurface joined = joined_surface(split.mesh);
  expect_joined_as(joined, split, mesh);
  EXPECT_EQ(joined.leaders, split.sources);
  EXPECT_EQ(joined.surface.face_vertices(), mesh.face_vertices());
  EXPECT_EQ(joined.followers.size(), split.mesh.vertex_count() - mesh.vertex_count());
  // A closed seam has as many edges as vertices, on either side.
  EXPECT_EQ(joined.edges.size(), 2 * joined.followers.size());
}

TEST(JoinedSurface, LeavesVerticesApartThatOnlyTouch) {
  Mesh tips;
  tips.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {-1, -1, 0}};
  add_polygon(tips, {0, 1, 2});
  add_polygon(tips, {3, 4, 5});
  EXPECT_TRUE(joined_surface(tips).empty());
}

TEST(JoinedSurface, JoinsAllSheetsThatMeetInAnEdgeWhateverTheirDirection) {
  Mesh sheets;
  sheets.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 0, 1},  {0, 0, 0},
                      {0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {-1, -1, 0}};
  add_polygon(sheets, {0, 1, 2});
  add_polygon(sheets, {3, 4, 5});
  add_polygon(sheets, {6, 7, 8});
  const JoinedSurface joined = joined_surface(sheets);
  EXPECT_THAT(joined.leaders, ElementsAre(0, 1, 2, 1, 0, 5, 0, 1, 8));
  EXPECT_THAT(joined.followers, ElementsAre(3, 4, 6, 7));
  EXPECT_EQ(joined.edges.size(), 3U);
}

TEST(JoinedSurface, ClosesOverATriangleWithTwoCornersAtOnePlace) {
  // The needle 3 4 5 between two triangles that meet along it.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0},
                    {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  add_polygon(mesh, {0, 1, 2});
  add_polygon(mesh, {3, 4, 5});
  add_polygon(mesh, {6, 7, 8});
  const JoinedSurface joined = joined_surface(mesh);
  EXPECT_THAT(joined.leaders, ElementsAre(0, 1, 2, 1, 2, 2, 1, 7, 2));
  EXPECT_EQ(joined.surface.topology().triangles.size(), 2U);
}

TEST(JoinedSurface, PassesOverFacesWithoutExtentAndPlacesThatAreNotFinite) {
  Mesh mesh;
  const double none = std::nan("");
  mesh.positions = {{none, 0, 0}, {0, 1, 0}, {1, 0, 0}, {none, 0, 0},
                    {0, 1, 0},    {2, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  add_polygon(mesh, {0, 1, 2});
  add_polygon(mesh, {3, 4, 5});
  add_polygon(mesh, {6, 7, 6});
  EXPECT_TRUE(joined_surface(mesh).empty());
}

TEST(JoinedSurface, ClosesToTheLastBitAndLeavesWhatAgrees) {
  const JoinedSurface joined = joined_surface(test::halves(grid(2, 2)).mesh);
  Positions positions = joined.surface.positions;
  EXPECT_TRUE(joined.is_closed_at(positions));
  const Index v = joined.followers[0];
  const Index other = joined.followers[1];
  positions[joined.leaders[v]] = {0.1, 0.2, 0.3};
  positions[joined.leaders[other]].z() = 0.0;
  positions[other].z() = -0.0;
  EXPECT_FALSE(joined.is_closed_at(positions));
  joined.close(positions);
  EXPECT_TRUE(joined.is_closed_at(positions));
  EXPECT_EQ(positions[v], Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_TRUE(std::signbit(positions[other].z()));
}

}  // namespace
}  // namespace lapwing
