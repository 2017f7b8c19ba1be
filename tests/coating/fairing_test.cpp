#include "lapwing/coating/fairing.h"

#include <numbers>

#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;

constexpr double kWaveHeight = 1e-3;

// The unit square with waves along x, `count` of them.
Mesh waves(Index cells, double count) {
  Mesh mesh = grid(cells, cells);
  for (Vector3d& p : mesh.positions) {
    p.z() = kWaveHeight * std::sin(2.0 * std::numbers::pi * count * p.x());
  }
  return mesh;
}

// What is left of the waves' height in the middle of the square, away from the held border.
double height_left(const Mesh& mesh, const Positions& smooth) {
  double product = 0.0;
  double square = 0.0;
  for (std::size_t v = 0; v < smooth.size(); ++v) {
    const Vector3d& p = mesh.positions[v];
    if ((p.head<2>() - Eigen::Vector2d(0.5, 0.5)).cwiseAbs().maxCoeff() > 0.25) continue;
    product += p.z() * smooth[v].z();
    square += p.z() * p.z();
  }
  return product / square;
}

struct FairingOf : testing::TestWithParam<LaplacianWeights> {};

TEST_P(FairingOf, HalvesAWaveOfTheLengthGiven) {
  const Mesh mesh = waves(64, 8.0);
  const Topology& topology = mesh.topology();
  const Fairing fairing(mesh.positions, topology, every_vertex(mesh), GetParam());
  EXPECT_NEAR(height_left(mesh, fairing.smooth(1.0 / 8.0)), 0.5, 0.03);
}

TEST_P(FairingOf, LeavesLongWavesAndTakesShortOnes) {
  const Mesh mesh = waves(64, 8.0);
  const Topology& topology = mesh.topology();
  const Fairing fairing(mesh.positions, topology, every_vertex(mesh), GetParam());
  EXPECT_NEAR(height_left(mesh, fairing.smooth(1.0 / 16.0)), 16.0 / 17.0, 0.03);
  EXPECT_NEAR(height_left(mesh, fairing.smooth(1.0 / 4.0)), 1.0 / 17.0, 0.03);
}

TEST_P(FairingOf, MeasuresInLengthsNotInTriangles) {
  for (const Index cells : {32U, 96U}) {
    const Mesh mesh = waves(cells, 4.0);
    const Topology& topology = mesh.topology();
    const Fairing fairing(mesh.positions, topology, every_vertex(mesh), GetParam());
    EXPECT_NEAR(height_left(mesh, fairing.smooth(0.25)), 0.5, 0.04) << cells;
  }
}

TEST_P(FairingOf, LeavesAPlaneAlone) {
  const Mesh mesh = grid(20, 20);
  const Topology& topology = mesh.topology();
  const Positions smooth =
      Fairing(mesh.positions, topology, every_vertex(mesh), GetParam()).smooth(0.3);
  for (std::size_t v = 0; v < smooth.size(); ++v) EXPECT_NEAR(smooth[v].z(), 0.0, 1e-14);
}

TEST_P(FairingOf, HoldsTheBorderBitForBit) {
  const Mesh mesh = bumpy_plane(24, 3, 0.1);
  const Topology& topology = mesh.topology();
  const VertexSet region = within(mesh, Vector3d(0.5, 0.5, 0.0), 0.35);
  const Fairing fairing(mesh.positions, topology, region, GetParam());
  const Positions smooth = fairing.smooth(0.2);
  const auto moves = vertex_mask(mesh.vertex_count(), fairing.free());
  ASSERT_GT(fairing.free().size(), 100U);
  for (std::size_t v = 0; v < smooth.size(); ++v) {
    if (moves[v]) continue;
    EXPECT_EQ(smooth[v], mesh.positions[v]) << v;
  }
}

TEST_P(FairingOf, TurnsMovesAndScalesWithTheSurface) {
  const Mesh mesh = bumpy_plane(20, 4, 0.08);
  const Topology& topology = mesh.topology();
  const Mesh moved = transformed(mesh, similarity(40.0));
  const Positions smooth =
      Fairing(mesh.positions, topology, every_vertex(mesh), GetParam()).smooth(0.2);
  const Positions moved_smooth =
      Fairing(moved.positions, topology, every_vertex(mesh), GetParam()).smooth(0.2 * 40.0);
  for (std::size_t v = 0; v < smooth.size(); ++v) {
    EXPECT_LT((moved_smooth[v] - similarity(40.0) * smooth[v]).norm(), 40.0 * 1e-9);
  }
}

std::string name_of_weights(const testing::TestParamInfo<LaplacianWeights>& test) {
  return test.param == LaplacianWeights::uniform ? "uniform" : "cotangent";
}

INSTANTIATE_TEST_SUITE_P(Weights, FairingOf,
                         testing::Values(LaplacianWeights::uniform, LaplacianWeights::cotangent),
                         name_of_weights);

TEST(Fairing, SmoothsAScanWhoseTrianglesDiffer) {
  // Twice as dense on one side: cotangents still take the same wave off both.
  Mesh mesh = waves(64, 8.0);
  for (Vector3d& p : mesh.positions) {
    p.y() = p.y() * (0.5 + 0.5 * p.y());
  }
  const Topology& topology = mesh.topology();
  const Fairing fairing(mesh.positions, topology, every_vertex(mesh), LaplacianWeights::cotangent);
  EXPECT_NEAR(height_left(mesh, fairing.smooth(1.0 / 8.0)), 0.5, 0.03);
}

TEST(Fairing, LeavesARegionWithoutInnerVerticesAlone) {
  const Mesh mesh = grid(4, 4);
  const Topology& topology = mesh.topology();
  const Fairing fairing(mesh.positions, topology, {0, 1, 2}, LaplacianWeights::cotangent);
  EXPECT_EQ(fairing.smooth(0.5), mesh.positions);
}

TEST(Fairing, SurvivesTrianglesWithoutArea) {
  Mesh mesh = grid(8, 8);
  mesh.positions[30] = mesh.positions[31];
  mesh.positions[40] = mesh.positions[31];
  const Topology& topology = mesh.topology();
  for (const auto weights : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
    const Positions smooth =
        Fairing(mesh.positions, topology, every_vertex(mesh), weights).smooth(0.3);
    for (const Vector3d& p : smooth) EXPECT_TRUE(p.allFinite());
  }
}

TEST(Fairing, RefusesALengthThatIsNone) {
  const Mesh mesh = grid(4, 4);
  const Topology& topology = mesh.topology();
  const Fairing fairing(mesh.positions, topology, every_vertex(mesh), LaplacianWeights::cotangent);
  for (const double length : {0.0, -1.0, std::nan("")}) {
    EXPECT_THAT(error_message<InputError>([&] { fairing.smooth(length, "detail_size"); }),
                testing::StartsWith("detail_size: expected a length above 0"));
  }
}

TEST(Grown, AddsWhatIsWithinTheDistance) {
  const Mesh mesh = grid(10, 10);
  const Topology& topology = mesh.topology();
  const VertexSet region = grown({60}, 0.21, topology, mesh.positions);
  EXPECT_EQ(region, within(mesh, mesh.positions[60], 0.21));
}

}  // namespace
}  // namespace lapwing::test
