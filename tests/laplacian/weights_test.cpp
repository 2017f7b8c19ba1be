#include "lapwing/laplacian/weights.h"

#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide.h"

namespace lapwing {
namespace {

double row_sum(const Adjacency& rings, const std::vector<double>& weights, std::size_t i) {
  double sum = 0.0;
  for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) sum += weights[e];
  return sum;
}

TEST(LaplacianWeights, EveryRowSumsToOne) {
  const Mesh mesh = torus(17, 9, 2.0, 0.7);
  const Topology& topology = mesh.topology();
  for (const auto scheme : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
    const auto weights = laplacian_weights(topology, mesh.positions, scheme);
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
      EXPECT_NEAR(row_sum(topology.rings, weights, i), 1.0, 1e-14);
    }
  }
}

TEST(LaplacianWeights, OfSomeRowsAreThoseOfAll) {
  const Mesh mesh = torus(17, 9, 2.0, 0.7);
  const Topology& topology = mesh.topology();
  const Adjacency& rings = topology.rings;
  const std::vector<Index> rows{90, 3, 40, 41};
  const auto expect_same = [&](std::span<const double> some, std::span<const double> all) {
    ASSERT_EQ(some.size(), all.size());
    for (const Index i : rows) {
      for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) {
        EXPECT_EQ(some[e], all[e]) << "vertex " << i;
      }
    }
  };
  for (const auto scheme : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
    expect_same(laplacian_weights(topology, mesh.positions, scheme, rows),
                laplacian_weights(topology, mesh.positions, scheme));
  }
  const auto sums = cotangent_sums(topology, mesh.positions, rows);
  expect_same(laplacian_weights(topology, sums, rows),
              laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent));
}

TEST(LaplacianWeights, CotangentLaplacianOfALinearFunctionIsZeroInsideThePlane) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {16, 0, 0}, {8, 8 * std::sqrt(3.0), 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  for (int s = 0; s < 4; ++s) mesh = subdivide(mesh);
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    // Vertices moved about, but not so far that an angle becomes obtuse.
    mesh.positions[i].x() += 0.05 * std::sin(37.0 * static_cast<double>(i));
    mesh.positions[i].y() += 0.05 * std::cos(11.0 * static_cast<double>(i));
  }
  const Topology& topology = mesh.topology();
  const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent);
  std::size_t inner = 0;
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    if (topology.vertex_triangles.size(i) != topology.rings.size(i)) continue;  // boundary
    ++inner;
    Eigen::Vector3d delta = mesh.positions[i];
    for (std::size_t e = topology.rings.starts[i]; e < topology.rings.starts[i + 1]; ++e) {
      delta -= weights[e] * mesh.positions[topology.rings.values[e]];
    }
    EXPECT_LT(delta.norm(), 1e-14) << "vertex " << i;
  }
  EXPECT_EQ(inner, 105U);
}

TEST(LaplacianWeights, ObtuseTrianglesKeepEveryNeighbour) {
  // Two flat slivers on one edge: the cotangent sum of that edge is far below zero.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.01, 0}, {0.5, -0.01, 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  mesh.add_face(std::array<Index, 3>{1, 0, 3});
  const Topology& topology = mesh.topology();
  for (const double w : laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent)) {
    EXPECT_GT(w, 0.0);
    EXPECT_LE(w, 1.0);
  }
}

TEST(LaplacianWeights, OfATriangleWithoutAreaAreThoseOfOneNextToIt) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0.8, 0, 0}, {2, 0, 0}, {1, 1, 0}};
  mesh.add_face(std::array<Index, 3>{0, 2, 1});
  mesh.add_face(std::array<Index, 3>{0, 2, 3});
  const Topology& topology = mesh.topology();
  const auto flat = laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent);
  for (const double height : {-1e-16, 1e-16, -1e-9, 1e-9}) {
    mesh.positions[1].y() = height;
    const auto next = laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent);
    for (std::size_t k = 0; k < flat.size(); ++k) EXPECT_NEAR(next[k], flat[k], 1e-8) << height;
  }
}

TEST(LaplacianWeights, RingAtOnePlaceFallsBackToUniform) {
  Mesh mesh;
  mesh.positions = {{1, 2, 0}, {1, 2, 0}, {1, 2, 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  const Topology& topology = mesh.topology();
  for (const double w : laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent)) {
    EXPECT_DOUBLE_EQ(w, 0.5);
  }
}

}  // namespace
}  // namespace lapwing
