#include <array>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/certificate_warnings.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

struct Sphere {
  Mesh mesh = icosphere(2);
  Topology topology = mesh.topology();
  std::vector<Index> all = std::vector<Index>(mesh.vertex_count());
  Sphere() { std::iota(all.begin(), all.end(), 0U); }

  Certificate measure(const Positions& current) const {
    Certificate certificate;
    measure_shape(all, topology, mesh.positions, current, certificate);
    return certificate;
  }
};

TEST(Certificate, OfASimilarityHoldsItsScaleAndAngle) {
  const Sphere sphere;
  Positions moved;
  for (const auto& p : sphere.mesh.positions) {
    moved.emplace_back(2.0 * (Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitY()) * p));
  }
  const Certificate c = sphere.measure(moved);
  EXPECT_NEAR(c.largest_rotation_degrees, 2.5 * 180.0 / std::numbers::pi, 1e-9);
  EXPECT_NEAR(c.smallest_scale, 2.0, 1e-12);
  EXPECT_NEAR(c.largest_scale, 2.0, 1e-12);
  EXPECT_EQ(c.flipped_triangles, 0U);
  EXPECT_TRUE(c.all_finite);
}

TEST(Certificate, DiagonalLeavesOutIsolatedVertices) {
  Sphere sphere;
  const double diagonal = sphere.measure(sphere.mesh.positions).rest_diagonal;
  sphere.mesh.positions.emplace_back(1000, 0, 0);
  sphere.mesh.edit_faces();
  sphere.topology = sphere.mesh.topology();
  EXPECT_EQ(sphere.measure(sphere.mesh.positions).rest_diagonal, diagonal);
  EXPECT_NEAR(diagonal, 2.0 * std::sqrt(3.0), 0.2);
}

TEST(Certificate, NamesTheTrianglesThatFaceTheOtherWay) {
  const Sphere sphere;
  Positions dented = sphere.mesh.positions;
  const Index neighbour = sphere.topology.rings[0][0];
  dented[0] += 2.5 * (dented[neighbour] - dented[0]);
  const Certificate c = sphere.measure(dented);
  EXPECT_GT(c.flipped_triangles, 0U);
  EXPECT_THAT(c.first_flipped_triangles, ::testing::Not(::testing::IsEmpty()));
}

// Two triangles on one long side, the second a thousandth or so as high as it is long.
TEST(Certificate, ATriangleThatIsOnlyALineHasNoSideToFlip) {
  const auto flips_at = [](double height) {
    Mesh mesh;
    mesh.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 1.0, 0.0}, {0.5, -height, 0.0}};
    mesh.add_face(std::array<Index, 3>{0, 1, 2});
    mesh.add_face(std::array<Index, 3>{1, 0, 3});
    Positions turned_over = mesh.positions;
    turned_over[3].y() = height;
    Certificate c;
    const std::vector<Index> all{0, 1, 2, 3};
    measure_shape(all, mesh.topology(), mesh.positions, turned_over, c);
    return c.flipped_triangles;
  };
  EXPECT_EQ(flips_at(1.1 * kThinnestTriangle), 1U);
  EXPECT_EQ(flips_at(0.9 * kThinnestTriangle), 0U);
  EXPECT_EQ(flips_at(0.0), 0U);
}

TEST(Certificate, NamesTheEdgeThatIsStretchedMost) {
  const Sphere sphere;
  EXPECT_EQ(sphere.measure(sphere.mesh.positions).largest_edge_stretch_vertices[0], kNoIndex);
  Positions pulled = sphere.mesh.positions;
  const Index end = sphere.topology.rings[7][0];
  pulled[7] += 2.0 * (pulled[7] - pulled[end]);
  const Certificate c = sphere.measure(pulled);
  EXPECT_NEAR(c.largest_edge_stretch, 2.0, 1e-12);
  EXPECT_THAT(c.largest_edge_stretch_vertices,
              ::testing::ElementsAre(std::min(7U, end), std::max(7U, end)));
}

TEST(Certificate, WhatTheHandlesAskForIsNoStretch) {
  const Sphere sphere;
  Positions grown = sphere.mesh.positions;
  for (auto& p : grown) p *= 4.0;
  const std::vector<Eigen::Matrix3d> asked(grown.size(), 4.0 * Eigen::Matrix3d::Identity());
  Certificate c;
  measure_shape(sphere.all, sphere.topology, sphere.mesh.positions, grown, c, asked);
  EXPECT_LT(c.largest_edge_stretch, 1e-12);
  EXPECT_NEAR(c.largest_scale, 4.0, 1e-12);
  EXPECT_THAT(warnings_of(c), ::testing::IsEmpty());
}

TEST(Certificate, WarnsOfWhatIsNotSettledFlippedOrFarTooLong) {
  EXPECT_THAT(warnings_of({}), ::testing::IsEmpty());
  Certificate c;
  c.settled = false;
  c.settle_iterations = 200;
  c.flipped_triangles = 2;
  c.first_flipped_triangles = {7, 9};
  c.largest_edge_stretch = 2.5;
  c.largest_edge_stretch_vertices = {3, 8};
  using ::testing::HasSubstr;
  EXPECT_THAT(warnings_of(c),
              ::testing::ElementsAre(HasSubstr("not settled after 200 iterations"),
                                     HasSubstr("2 triangles are flipped, the first 7"),
                                     HasSubstr("from vertex 3 to 8 is now 3.5 times as long")));
  EXPECT_THAT(warnings_of(c)[0], HasSubstr("Raise \"max_iterations\""));
  c.lacks_hessian = true;
  EXPECT_THAT(warnings_of(c)[0], HasSubstr("memory"));
  c.largest_edge_stretch = 1.9;
  EXPECT_EQ(warnings_of(c).size(), 2U);
}

TEST(Certificate, FailsOnWhatIsNotFiniteAndOnALargeResidual) {
  const Sphere sphere;
  Positions broken = sphere.mesh.positions;
  broken[3].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(require_valid(sphere.measure(broken)), SolverError);
  Certificate loose;
  loose.relative_residual = 2.0 * kLargestResidual;
  EXPECT_THROW(require_valid(loose), SolverError);
  Certificate far;
  far.handle_error = std::numeric_limits<double>::infinity();
  EXPECT_THROW(require_valid(far), SolverError);
  EXPECT_NO_THROW(require_valid(Certificate{}));
}

}  // namespace
}  // namespace lapwing
