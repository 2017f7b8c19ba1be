#include "lapwing/transfer/pose_maps.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::array<double, 3> kCentroid{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};

// A sphere whose upper half is twisted.
Positions twisted(const Mesh& mesh) {
  Positions posed = mesh.positions;
  for (Vector3d& p : posed) p = AngleAxisd(1.2 * p.z(), Vector3d::UnitZ()) * p;
  return posed;
}

Matrix3d product(const LinearMap& map) {
  return map.R * map.S;
}

TEST(PoseMaps, OfATriangleMapsItsEdgesExactly) {
  const Mesh mesh = icosphere(2);
  const Positions posed = twisted(mesh);
  const Topology& topology = mesh.topology();
  const PoseMaps maps(topology, PoseMaps::prepare(topology, mesh.positions), posed);
  for (Index t = 0; t < topology.triangles.size(); ++t) {
    const LinearMap map = maps.at(t, kCentroid);
    const auto& [a, b, c] = topology.triangles[t];
    for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
      const Vector3d edge = mesh.positions[to] - mesh.positions[from];
      EXPECT_LT((product(map) * edge - (posed[to] - posed[from])).norm(), 1e-12);
    }
    EXPECT_TRUE(map.S.isApprox(map.S.transpose(), 1e-9));
    EXPECT_NEAR(map.R.determinant(), 1.0, 1e-12);
  }
}

TEST(PoseMaps, OfASimilarityAreTheSimilarityEverywhere) {
  const Mesh mesh = icosphere(2);
  const Matrix3d similarity = 2.0 * AngleAxisd(2.5, Vector3d(1, 2, 3).normalized()).matrix();
  Positions posed = mesh.positions;
  for (Vector3d& p : posed) p = similarity * p + Vector3d(5.0, 0.0, 0.0);
  const PoseMaps maps(mesh.topology(), PoseMaps::prepare(mesh.topology(), mesh.positions), posed);
  EXPECT_TRUE(product(maps.at(7, {0.7, 0.2, 0.1})).isApprox(similarity, 1e-9));
}

TEST(PoseMaps, AreContinuousOverAnEdge) {
  const Mesh mesh = icosphere(1);
  const Topology& topology = mesh.topology();
  const PoseMaps maps(topology, PoseMaps::prepare(topology, mesh.positions), twisted(mesh));
  const auto at_edge = [&](Index t, Index from, Index to) {
    std::array<double, 3> weights{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (topology.triangles[t][k] == from) weights[k] = 0.3;
      if (topology.triangles[t][k] == to) weights[k] = 0.7;
    }
    return product(maps.at(t, weights));
  };
  const Index from = topology.triangles[0][0];
  const Index to = topology.triangles[0][1];
  for (const Index t : topology.vertex_triangles[from]) {
    const Triangle& corners = topology.triangles[t];
    if (std::ranges::count(corners, to) == 0) continue;
    EXPECT_TRUE(at_edge(t, from, to).isApprox(at_edge(0, from, to), 1e-12));
  }
}

TEST(PoseMaps, AMeanOfRotationsIsARotation) {
  LinearMap sum;
  for (const double angle : {0.0, 1.0}) {
    sum.add(0.5, {AngleAxisd(angle, Vector3d::UnitX()).matrix(), Matrix3d::Identity()});
  }
  EXPECT_TRUE(product(mean_map(sum)).isApprox(AngleAxisd(0.5, Vector3d::UnitX()).matrix(), 1e-12));
}

TEST(PoseMaps, ATriangleWithoutAreaHasNone) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  mesh.add_face(std::array<Index, 3>{0, 1, 2});
  mesh.add_face(std::array<Index, 3>{0, 1, 3});
  const PoseMaps::Rest rest = PoseMaps::prepare(mesh.topology(), mesh.positions);
  EXPECT_EQ(rest.areas[0], 0.0);
  EXPECT_NEAR(rest.areas[1], 0.5, 1e-12);
}

}  // namespace
}  // namespace lapwing
