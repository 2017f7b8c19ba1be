#include "lapwing/region/submesh.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

struct SubmeshOfAGrid : testing::Test {
  Mesh mesh = bumpy_plane(12, 2, 0.2);
  Topology topology = mesh.topology();
  VertexSet region{40, 41, 42, 53, 54, 55, 66, 67, 68, 100};
  Submesh part = submesh_around(region, topology);

  VertexSet in_mesh(std::span<const Index> own) const {
    VertexSet vertices;
    for (const Index v : own) vertices.push_back(part.vertices[v]);
    return vertices;
  }
};

TEST_F(SubmeshOfAGrid, HoldsTheRegionAndItsNeighbours) {
  EXPECT_EQ(part.vertices, with_ring_neighbours(region, topology.rings));
  EXPECT_EQ(in_mesh(part.region), region);
  EXPECT_EQ(own_numbers(part, region), part.region);
}

TEST_F(SubmeshOfAGrid, LeavesTheRegionItsRingsAndTriangles) {
  for (const Index own : part.region) {
    const Index v = part.vertices[own];
    const auto ring = topology.rings[v];
    EXPECT_EQ(in_mesh(part.topology.rings[own]), VertexSet(ring.begin(), ring.end()));
    const auto around = topology.vertex_triangles[v];
    const auto own_around = part.topology.vertex_triangles[own];
    ASSERT_EQ(own_around.size(), around.size());
    for (std::size_t k = 0; k < around.size(); ++k) {
      const Triangle& whole = topology.triangles[around[k]];
      EXPECT_EQ(in_mesh(part.topology.triangles[own_around[k]]),
                VertexSet(whole.begin(), whole.end()));
    }
  }
}

TEST_F(SubmeshOfAGrid, GivesTheRegionTheWeightsOfTheMeshBitForBit) {
  const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent);
  const auto own = laplacian_weights(part.topology, part.own<Eigen::Vector3d>(mesh.positions),
                                     LaplacianWeights::cotangent);
  for (const Index v : part.region) {
    for (std::size_t e = 0; e < part.topology.rings.size(v); ++e) {
      EXPECT_EQ(own[part.topology.rings.starts[v] + e],
                weights[topology.rings.starts[part.vertices[v]] + e]);
    }
  }
}

TEST(Submesh, OfNoRegionIsEmpty) {
  const Submesh part = submesh_around({}, build_topology(grid(3, 3)));
  EXPECT_TRUE(part.vertices.empty());
  EXPECT_EQ(part.topology.vertex_count(), 0U);
}

}  // namespace
}  // namespace lapwing
