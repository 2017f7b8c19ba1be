#include "lapwing/mesh/edges.h"

#include <array>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/incident_edges.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

TEST(Edges, ListEachEdgeOnceWithItsSides) {
  Mesh mesh;
  mesh.positions.resize(5);
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<Index, 3>{2, 1, 4});
  const Edges edges = build_edges(mesh);
  using Ends = std::array<Index, 2>;
  EXPECT_THAT(edges.ends,
              ElementsAre(Ends{0, 1}, Ends{0, 3}, Ends{1, 2}, Ends{1, 4}, Ends{2, 3}, Ends{2, 4}));
  EXPECT_THAT(edges.sides[2], ElementsAre(1, 4));
  EXPECT_TRUE(edges.is_boundary(0));
  EXPECT_FALSE(edges.is_boundary(2));
}

TEST(Edges, EverySideLiesOnItsEdge) {
  const Mesh mesh = torus(7, 5, 2.0, 0.5);
  const Edges edges = build_edges(mesh);
  EXPECT_EQ(edges.count(), 3 * mesh.vertex_count());
  for (Index c = 0; c < mesh.face_vertices().size(); ++c) {
    const Index edge = edges.edge_of_side[c];
    EXPECT_THAT(edges.ends[edge],
                ::testing::UnorderedElementsAre(mesh.face_vertices()[c],
                                                mesh.face_vertices()[edges.next_corner[c]]));
    EXPECT_THAT(edges.sides[edge], ::testing::Contains(c));
  }
}

TEST(Edges, LeaveOutMaskedFacesAndSidesWithoutLength) {
  Mesh mesh;
  mesh.positions.resize(4);
  mesh.add_face(std::array<Index, 4>{0, 1, 1, 2});
  mesh.add_face(std::array<Index, 3>{1, 2, 3});
  const Edges edges = build_edges(mesh, {1, 0});
  EXPECT_EQ(edges.count(), 3U);
  EXPECT_EQ(edges.edge_of_side[1], kNoIndex);
  EXPECT_EQ(edges.edge_of_side[5], kNoIndex);
}

TEST(Fans, OfAFaceThatRepeatsACornerAreOne) {
  Mesh mesh = grid(1, 1);
  for (const auto& face :
       {std::vector<Index>{0, 1, 3, 2, 0}, {0, 0, 1, 3, 2}, {0, 1, 1, 1, 3, 2}}) {
    mesh.edit_faces() = {};
    mesh.add_face(face);
    EXPECT_THAT(find_fans(mesh, build_edges(mesh)).bow_tie_vertices, ::testing::IsEmpty());
  }
}

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

bool is_plain_in(const Topology& topology, Index v) {
  return has_plain_spokes(v, topology.vertex_triangles[v], topology.triangles);
}

TEST(Spokes, CountTrianglesByTheSideTheyAreOn) {
  const std::vector<Triangle> triangles{{0, 1, 2}, {3, 0, 2}, {0, 4, 3}};
  const std::vector<IncidentEdge> spokes =
      incident_edges(0, std::vector<Index>{0, 1, 2}, triangles);
  ASSERT_EQ(spokes.size(), 4U);
  const std::vector<std::array<std::size_t, 3>> expected{
      {1, 1, 0}, {2, 1, 1}, {3, 0, 2}, {4, 1, 0}};
  for (std::size_t k = 0; k < spokes.size(); ++k) {
    EXPECT_EQ(spokes[k].to, expected[k][0]);
    EXPECT_EQ(spokes[k].as_next, expected[k][1]);
    EXPECT_EQ(spokes[k].as_last, expected[k][2]);
  }
  EXPECT_EQ(spokes[2].triangles(), 2U);
  EXPECT_FALSE(spokes[2].is_plain());
  EXPECT_TRUE(spokes[1].is_plain());
}

TEST(Spokes, VertexIsPlainInsideASurfaceOfOneOrientation) {
  const Mesh sheet = grid(4, 4);
  const Topology& topology = sheet.topology();
  for (Index v = 0; v < sheet.vertex_count(); ++v) {
    const bool is_inside = topology.rings.size(v) == topology.vertex_triangles.size(v);
    EXPECT_EQ(is_plain_in(topology, v), is_inside) << "vertex " << v;
  }
  Topology turned = topology;
  std::swap(turned.triangles[9][1], turned.triangles[9][2]);
  for (const Index v : turned.triangles[9]) EXPECT_FALSE(is_plain_in(turned, v));
}

}  // namespace
}  // namespace lapwing
