#include "lapwing/laplacian/energy_weights.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/subdivide.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr EnergyTerms kTerms{LaplacianWeights::cotangent, 0.1};

std::vector<Index> all_vertices(const Mesh& mesh) {
  std::vector<Index> all(mesh.vertex_count());
  for (Index v = 0; v < all.size(); ++v) all[v] = v;
  return all;
}

// The energy of a smooth field over a whole mesh, per vertex: rows and edges.
struct Energies {
  double rows = 0.0;
  double edges = 0.0;
};
template <typename Field>
Energies energies_of(const Mesh& mesh, const Field& field) {
  const Topology& topology = mesh.topology();
  const EnergyWeights weights =
      energy_weights(topology, mesh.positions, all_vertices(mesh), kTerms);
  Energies sum;
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    Vector3d L = Vector3d::Zero();
    for (std::size_t e = topology.rings.starts[i]; e < topology.rings.starts[i + 1]; ++e) {
      const Vector3d difference =
          field(mesh.positions[i]) - field(mesh.positions[topology.rings.values[e]]);
      L += weights.laplacian[e] * difference;
      sum.edges += weights.stiffness[e] * difference.squaredNorm();
    }
    sum.rows += weights.rows[i] * L.squaredNorm();
  }
  return sum;
}

// Returns the value of a field whose Laplacian on a sphere is nonzero.
Vector3d wave(const Vector3d& p) {
  return {std::sin(2.0 * p.x()), std::cos(2.0 * p.y()), 0.0};
}

// Both sums approximate integrals, so their ratio is the same for every mesh of a surface.
TEST(EnergyWeights, RefiningTheMeshKeepsTheRatioOfRowsAndEdges) {
  const Energies coarse = energies_of(icosphere(3), wave);
  const Energies fine = energies_of(icosphere(4), wave);
  EXPECT_NEAR(coarse.rows / coarse.edges, fine.rows / fine.edges, 0.05 * fine.rows / fine.edges);
}

// Vertices far from the region do not affect the weights.
TEST(EnergyWeights, AreThoseOfTheRegionAlone) {
  Mesh mesh = icosphere(3);
  const Topology& topology = mesh.topology();
  std::vector<Index> region;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions[v].z() > 0.6) region.push_back(v);
  }
  const EnergyWeights before = energy_weights(topology, mesh.positions, region, kTerms);
  for (Vector3d& p : mesh.positions) {
    if (p.z() < 0.2) p *= 3.0;
  }
  const EnergyWeights after = energy_weights(topology, mesh.positions, region, kTerms);
  for (const Index i : region) {
    EXPECT_EQ(before.rows[i], after.rows[i]);
    for (std::size_t e = topology.rings.starts[i]; e < topology.rings.starts[i + 1]; ++e) {
      EXPECT_EQ(before.laplacian[e], after.laplacian[e]);
      EXPECT_EQ(before.stiffness[e], after.stiffness[e]);
      EXPECT_GT(after.stiffness[e], 0.0);
    }
  }
}

TEST(EnergyWeights, StiffnessIsTheSameFromBothEndsAndPositive) {
  const Mesh mesh = rippled_cylinder(24, 31);
  const Topology& topology = mesh.topology();
  const EnergyWeights weights =
      energy_weights(topology, mesh.positions, all_vertices(mesh), kTerms);
  const Adjacency& rings = topology.rings;
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) {
      const Index j = rings.values[e];
      const auto back = std::lower_bound(rings[j].begin(), rings[j].end(), i) - rings[j].begin();
      EXPECT_GT(weights.stiffness[e], 0.0);
      EXPECT_DOUBLE_EQ(weights.stiffness[e],
                       weights.stiffness[rings.starts[j] + static_cast<std::size_t>(back)]);
    }
  }
}

// Let the field be the positions on a sphere of radius R. Per unit of area, the squared gradients
// sum to 2. The Laplacian is 2 / R along the normal, so its square is 4 / R^2.
TEST(EnergyWeights, TheLengthIsAShareOfTheRadius) {
  for (const double radius : {1.0, 5.0}) {
    Mesh mesh = icosphere(4);
    for (Vector3d& p : mesh.positions) p *= radius;
    const Energies sums = energies_of(mesh, [](const Vector3d& p) { return p; });
    const double length = kTerms.detail_length * radius;
    const double expected = 2.0 / (length * length * 4.0 / (radius * radius));
    EXPECT_NEAR(sums.edges / sums.rows, expected, 0.02 * expected);
  }
}

TEST(EnergyWeights, WithoutADetailLengthTheyAreLaplaciansAlone) {
  const Mesh mesh = icosphere(1);
  const Topology& topology = mesh.topology();
  const EnergyWeights weights = energy_weights(topology, mesh.positions, all_vertices(mesh),
                                               {LaplacianWeights::uniform, 0.0});
  EXPECT_TRUE(weights.rows.empty());
  EXPECT_TRUE(weights.stiffness.empty());
  EXPECT_THAT(weights.laplacian, ::testing::ElementsAreArray(laplacian_weights(
                                     topology, mesh.positions, LaplacianWeights::uniform)));
}

TEST(EnergyWeights, WithOtherLaplaciansTheRestStaysToTheBit) {
  Mesh mesh = icosphere(2);
  for (Vector3d& p : mesh.positions) p += 0.1 * wave(3.0 * p);
  const std::vector<Index> roi = all_vertices(mesh);
  const auto weights = [&](LaplacianWeights scheme) {
    return energy_weights(mesh.topology(), mesh.positions, roi, {scheme, kTerms.detail_length});
  };
  for (const auto scheme : {LaplacianWeights::cotangent, LaplacianWeights::uniform}) {
    for (const auto before : {LaplacianWeights::cotangent, LaplacianWeights::uniform}) {
      const EnergyWeights now =
          with_laplacian(weights(before), mesh.topology(), mesh.positions, roi, scheme);
      const EnergyWeights expected = weights(scheme);
      EXPECT_THAT(now.laplacian, ::testing::ElementsAreArray(expected.laplacian));
      EXPECT_THAT(now.rows, ::testing::ElementsAreArray(expected.rows));
      EXPECT_THAT(now.stiffness, ::testing::ElementsAreArray(expected.stiffness));
    }
  }
}

TEST(EnergyWeights, OfTrianglesWithoutAreaAreFinite) {
  Mesh mesh = grid(4, 4);
  for (Vector3d& p : mesh.positions) p.y() = 0.0;
  const Topology& topology = mesh.topology();
  const EnergyWeights weights =
      energy_weights(topology, mesh.positions, all_vertices(mesh), kTerms);
  for (const double w : weights.rows) EXPECT_TRUE(std::isfinite(w));
  for (const double w : weights.stiffness) EXPECT_TRUE(std::isfinite(w) && w > 0.0);
}

}  // namespace
}  // namespace lapwing
