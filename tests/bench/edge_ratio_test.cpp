#include "studies/real/edge_ratio.h"

#include <numeric>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing::bench {
namespace {

std::vector<Index> all_of(const Mesh& mesh) {
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

TEST(EdgeRatio, IsThatOfTheMostStretchedEdge) {
  const Mesh mesh = grid(2, 2);
  Positions wider = mesh.positions;
  for (Eigen::Vector3d& p : wider) p.x() *= 3.0;
  EXPECT_DOUBLE_EQ(largest_edge_ratio(all_of(mesh), mesh.topology(), mesh.positions, wider), 3.0);
}

TEST(EdgeRatio, DoesNotCountWhatShrinks) {
  const Mesh mesh = grid(2, 2);
  Positions narrower = mesh.positions;
  for (Eigen::Vector3d& p : narrower) p.x() *= 0.01;
  EXPECT_DOUBLE_EQ(largest_edge_ratio(all_of(mesh), mesh.topology(), mesh.positions, narrower),
                   1.0);
}

TEST(EdgeRatio, PassesOverEdgesWithoutLengthAtRest) {
  Mesh mesh = grid(2, 2);
  const Positions current = mesh.positions;
  const Topology& topology = mesh.topology();
  mesh.positions[1] = mesh.positions[0];
  const std::vector<Index> corner{0};
  EXPECT_LT(largest_edge_ratio(corner, topology, mesh.positions, current), 10.0);
}

}  // namespace
}  // namespace lapwing::bench
