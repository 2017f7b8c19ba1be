#include "lapwing/doctor/statistics.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/doctor/check.h"
#include "lapwing/mesh/shapes.h"
#include "support/joined_meshes.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

MeshStatistics statistics_of(const Mesh& mesh) {
  return check(mesh).statistics;
}

// Adds `other` as a second component.
Mesh beside(const Mesh& mesh, Mesh other) {
  for (Eigen::Vector3d& p : other.positions) p.x() += 100.0;
  return test::joined(mesh, other);
}

TEST(MeshStatistics, SphereIsClosedWithoutHandles) {
  const MeshStatistics s = statistics_of(icosphere(2));
  EXPECT_EQ(s.vertices, 162U);
  EXPECT_EQ(s.triangles, 320U);
  EXPECT_EQ(s.edges, 480U);
  EXPECT_EQ(s.boundary_edges, 0U);
  EXPECT_EQ(s.boundary_loops, 0U);
  EXPECT_EQ(s.euler_characteristic, 2);
  EXPECT_THAT(s.genus, Optional(0));
}

TEST(MeshStatistics, TorusHasOneHandle) {
  const MeshStatistics s = statistics_of(torus(8, 6, 2.0, 0.5));
  EXPECT_EQ(s.euler_characteristic, 0);
  EXPECT_THAT(s.genus, Optional(1));
}

TEST(MeshStatistics, TubeHasTwoBoundaryLoops) {
  const MeshStatistics s = statistics_of(cylinder(7, 4, 1.0, 2.0));
  EXPECT_EQ(s.boundary_edges, 14U);
  EXPECT_EQ(s.boundary_loops, 2U);
  EXPECT_EQ(s.euler_characteristic, 0);
  EXPECT_THAT(s.genus, Optional(0));
}

TEST(MeshStatistics, GridMeasuresTheUnitSquare) {
  const MeshStatistics s = statistics_of(grid(4, 4));
  EXPECT_DOUBLE_EQ(s.area, 1.0);
  EXPECT_DOUBLE_EQ(s.min_edge_length, 0.25);
  EXPECT_DOUBLE_EQ(s.max_edge_length, 0.25 * std::numbers::sqrt2);
  EXPECT_DOUBLE_EQ(s.mean_edge_length, (40 * 0.25 + 16 * 0.25 * std::numbers::sqrt2) / 56);
  EXPECT_EQ(s.bounds.max, Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(s.boundary_loops, 1U);
}

TEST(MeshStatistics, GenusAddsUpOverComponents) {
  const MeshStatistics s =
      statistics_of(beside(torus(8, 6, 2.0, 0.5), beside(grid(2, 2), torus(8, 6, 2.0, 0.5))));
  EXPECT_THAT(s.component_sizes, ElementsAre(48, 48, 9));
  EXPECT_THAT(s.genus, Optional(2));
}

TEST(MeshStatistics, PolygonEdgesLeaveOutDiagonals) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  add_polygon(mesh, {0, 1, 2, 3});
  const MeshStatistics s = statistics_of(mesh);
  EXPECT_EQ(s.edges, 4U);
  EXPECT_EQ(s.triangles, 2U);
  EXPECT_EQ(s.euler_characteristic, 1);
}

TEST(MeshStatistics, HolesThatTouchAtABowTieAreTwoLoops) {
  const MeshStatistics s = statistics_of(bow_tie());
  EXPECT_EQ(s.boundary_loops, 2U);
  EXPECT_FALSE(s.genus.has_value());
}

TEST(MeshStatistics, NonFiniteVerticesDoNotSpoilTheSums) {
  Mesh mesh = grid(2, 2);
  mesh.positions[0].x() = std::nan("");
  const MeshStatistics s = statistics_of(mesh);
  EXPECT_DOUBLE_EQ(s.area, 0.75);
  EXPECT_DOUBLE_EQ(s.min_edge_length, 0.5);
}

}  // namespace
}  // namespace lapwing
