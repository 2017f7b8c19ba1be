#include "lapwing/mesh/triangle_sides.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

TEST(TriangleSides, AreListedEdgeByEdge) {
  const std::vector<Triangle> triangles{{3, 1, 0}, {0, 1, 2}};
  const Adjacency edges = sides_by_edge(triangles, 4);
  ASSERT_EQ(edges.row_count(), 5U);
  EXPECT_THAT(edges[0], ElementsAre(1, 3)) << "0-1";
  EXPECT_THAT(edges[1], ElementsAre(5)) << "0-2";
  EXPECT_THAT(edges[2], ElementsAre(2)) << "0-3";
  EXPECT_THAT(edges[3], ElementsAre(4)) << "1-2";
  EXPECT_THAT(edges[4], ElementsAre(0)) << "1-3";
  EXPECT_EQ(side_start(triangles, 2), 0U);
  EXPECT_EQ(side_end(triangles, 2), 3U);
}

TEST(TriangleSides, OfAClosedSurfaceArePairsOfOppositeWays) {
  const Topology topology = build_topology(icosphere(2));
  const Adjacency edges = sides_by_edge(topology.triangles, topology.vertex_count());
  EXPECT_EQ(edges.row_count(), topology.rings.values.size() / 2);
  for (std::size_t e = 0; e < edges.row_count(); ++e) {
    ASSERT_EQ(edges.size(e), 2U);
    EXPECT_EQ(side_start(topology.triangles, edges[e][0]),
              side_end(topology.triangles, edges[e][1]));
  }
}

TEST(TriangleSides, OfNothingAreNone) {
  EXPECT_EQ(sides_by_edge({}, 3).row_count(), 0U);
  EXPECT_EQ(sides_by_edge({}, 0).row_count(), 0U);
}

}  // namespace
}  // namespace lapwing
