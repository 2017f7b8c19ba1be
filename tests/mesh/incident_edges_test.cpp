#include "lapwing/mesh/incident_edges.h"

#include <array>
#include <utility>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

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
