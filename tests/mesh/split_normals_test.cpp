#include "lapwing/mesh/split_normals.h"

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

SplitNormals split(const Mesh& mesh, double degrees = kFeatureAngleDegrees) {
  return split_normals(mesh.positions, mesh.topology(), degrees);
}

// Returns the `sides` flat faces of a prism, without its two ends.
Mesh prism(Index sides) {
  Mesh mesh;
  for (Index s = 0; s < sides; ++s) {
    const double angle = 2.0 * std::numbers::pi * s / sides;
    for (const double z : {0.0, 1.0})
      mesh.positions.emplace_back(std::cos(angle), std::sin(angle), z);
  }
  for (Index s = 0; s < sides; ++s) {
    const Index next = (s + 1) % sides;
    mesh.add_face(std::array<Index, 4>{2 * s, 2 * next, 2 * next + 1, 2 * s + 1});
  }
  return mesh;
}

// Each face of a cube has separate normals.
TEST(SplitNormals, CubeHasThreeAtEachCornerAndOneInItsFaces) {
  const Mesh cube = bar(2, 2, 1.0, 1.0);
  const Topology& topology = cube.topology();
  const SplitNormals normals = split(cube);
  std::vector<std::set<Index>> of_vertex(cube.vertex_count());
  std::vector<std::vector<Vector3d>> directions(cube.vertex_count() +
                                                normals.extra_vertices.size());
  for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
    const auto& [a, b, c] = topology.triangles[t];
    const Vector3d normal = (cube.positions[b] - cube.positions[a])
                                .cross(cube.positions[c] - cube.positions[a])
                                .normalized();
    for (std::size_t k = 0; k < 3; ++k) {
      of_vertex[topology.triangles[t][k]].insert(normals.of_corner[3 * t + k]);
      directions[normals.of_corner[3 * t + k]].push_back(normal);
    }
  }
  const Bounds box = bounds_of(cube.positions);
  for (std::size_t v = 0; v < cube.vertex_count(); ++v) {
    const Eigen::Array3d place = cube.positions[v];
    const auto sides = (place == box.min.array() || place == box.max.array()).count();
    EXPECT_THAT(of_vertex[v], SizeIs(static_cast<std::size_t>(sides))) << "vertex " << v;
    EXPECT_TRUE(of_vertex[v].contains(static_cast<Index>(v)));
  }
  for (const auto& shared : directions) {
    for (const Vector3d& each : shared) EXPECT_LT((each - shared.front()).norm(), 1e-12);
  }
}

// The angle between adjacent faces of a regular prism with n sides is 360 / n degrees.
TEST(SplitNormals, EdgesAreHardAboveTheFeatureAngleOnly) {
  EXPECT_THAT(split(prism(8)).extra_vertices, SizeIs(16)) << "45 degrees";
  EXPECT_THAT(split(prism(9)).extra_vertices, IsEmpty()) << "40 degrees";
  EXPECT_THAT(split(prism(9), 39.9).extra_vertices, SizeIs(18));
  EXPECT_THAT(split(prism(4), 91.0).extra_vertices, IsEmpty());
  EXPECT_THAT(split(icosphere(3)).extra_vertices, IsEmpty());
  EXPECT_THAT(split(bar(2, 2, 1.0, 1.0), 180.0).extra_vertices, IsEmpty());
}

// The triangles around vertex 0 form a crease only at the edge to vertex 1.
TEST(SplitNormals, OneHardEdgeThatEndsAtAVertexDoesNotSplitIt) {
  constexpr Index kTriangles = 12;
  Mesh dart;
  dart.positions = {Vector3d::Zero()};
  for (Index k = 0; k < kTriangles; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kTriangles;
    dart.positions.emplace_back(std::cos(angle), std::sin(angle), -0.8 * std::sin(0.5 * angle));
    dart.add_face(std::array<Index, 3>{0, 1 + k, 1 + (k + 1) % kTriangles});
  }
  const SplitNormals normals = split(dart, 30.0);
  EXPECT_THAT(normals.extra_vertices, ElementsAre(1U)) << "the other end, on the boundary";
}

TEST(SplitNormals, SheetsThatShareAnEdgeOrFaceOppositeWaysHaveTheirOwn) {
  Mesh leaves;  // three triangles that share edge 0-1
  leaves.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0.2, 0}, {-1, -0.2, 0}};
  for (const Triangle& t : {Triangle{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}) leaves.add_face(t);
  EXPECT_THAT(split(leaves, 20.0).extra_vertices, ElementsAre(0U, 0U, 1U, 1U));
  Mesh opposite;
  opposite.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  for (const Triangle& t : {Triangle{0, 1, 2}, {1, 2, 3}}) opposite.add_face(t);
  EXPECT_THAT(split(opposite).extra_vertices, ElementsAre(1U, 2U));
}

// A triangle without area between the two sides of an edge does not make the edge smooth.
TEST(SplitNormals, TrianglesWithoutAreaDoNotSmoothAnEdge) {
  Mesh roof;
  roof.positions = {{0, 0, 0}, {0, 2, 0}, {0, 1, 0}, {1, 1, -1}, {-1, 1, -1}};
  for (const Triangle& t : {Triangle{0, 3, 1}, {0, 1, 2}, {0, 2, 4}, {2, 1, 4}}) roof.add_face(t);
  const SplitNormals normals = split(roof);
  EXPECT_THAT(normals.extra_vertices, ElementsAre(0U, 1U));
  EXPECT_THAT(split_normals(Positions(5, Vector3d::Zero()), roof.topology(), 40.0).extra_vertices,
              IsEmpty());
}

TEST(SplitNormals, TrianglesOfOnePolygonShareThem) {
  Mesh bent;  // a square with one corner lifted out of its plane
  bent.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}};
  bent.add_face(std::array<Index, 4>{0, 1, 2, 3});
  EXPECT_THAT(split(bent, 0.0).extra_vertices, IsEmpty());
}

}  // namespace
}  // namespace lapwing
