#include "lapwing/mesh/edges.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace lapwing
