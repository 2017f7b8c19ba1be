#include "lapwing/remesh/isotropic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/remesh/remesh.h"
#include "remesh/remesh_checks.h"

namespace lapwing {
namespace {

using namespace test;
using Eigen::Vector3d;

// The grid as squares.
Mesh quad_grid(Index cells) {
  Mesh mesh;
  mesh.positions = grid(cells, cells).positions;
  const Index row = cells + 1;
  for (Index r = 0; r < cells; ++r) {
    for (Index c = 0; c < cells; ++c) {
      const Index v = r * row + c;
      mesh.add_face(std::array{v, v + 1, v + row + 1, v + row});
    }
  }
  return mesh;
}

bool in_middle(const Vector3d& p) {
  return (p - Vector3d(0.5, 0.5, p.z())).norm() < 0.35;
}

class RemeshIcosphere : public ::testing::TestWithParam<double> {};

// Measured over all edges and triangles: the target is from 3 times to 0.7 of the input's edges.
TEST_P(RemeshIcosphere, GivesNearlyEquilateralTrianglesOnTheSphere) {
  const Mesh sphere = icosphere(4);
  const double length = GetParam();
  const RemeshResult result = remesh_all(sphere, length);
  EXPECT_EQ(shape_of(result.mesh), shape_of(sphere));
  EXPECT_GE(share_of_good_edges(result.mesh, everywhere(length)), 0.99);
  EXPECT_GE(region_quality(result.mesh, result.region).smallest_angle_degrees, 30.0);
  EXPECT_EQ(result.note, "");
  for (std::size_t f = 0; f < result.mesh.face_count(); ++f) {
    const Vector3d& corner = result.mesh.positions[result.mesh.face(f)[0]];
    ASSERT_GT(area_vector(result.mesh, f).normalized().dot(corner), 0.9) << "face " << f;
  }
  // Vertices are on the icosphere, whose edges of 0.07 dip by 0.0008 below the unit sphere.
  for (const Vector3d& p : result.mesh.positions) {
    ASSERT_NEAR(p.norm(), 0.9992, 0.00081);
  }
}

INSTANTIATE_TEST_SUITE_P(CoarserAndFiner, RemeshIcosphere, ::testing::Values(0.2, 0.1, 0.05));

TEST(RemeshIsotropic, KeepsAPlaneFlatAndItsArea) {
  for (const double length : {0.03, 0.05}) {
    const Mesh plane = grid(24, 24);
    const RemeshResult result = remesh_all(plane, length);
    EXPECT_EQ(shape_of(result.mesh), shape_of(plane));
    EXPECT_NEAR(area(result.mesh), 1.0, 1e-12);
    for (std::size_t f = 0; f < result.mesh.face_count(); ++f) {
      ASSERT_GT(area_vector(result.mesh, f).z(), 0.0) << "folded at face " << f;
    }
    for (const Vector3d& p : result.mesh.positions) ASSERT_EQ(p.z(), 0.0);
    EXPECT_GE(share_of_good_edges(result.mesh, everywhere(length)), 0.97);
    EXPECT_GE(region_quality(result.mesh, result.region).smallest_angle_degrees, 25.0);
  }
}

TEST(RemeshIsotropic, LeavesEverythingOutsideAndTheBorderAloneAmongQuads) {
  Mesh mesh = quad_grid(20);
  for (Vector3d& p : mesh.positions) p.z() = 0.1 * std::sin(3.0 * p.x()) * std::cos(2.0 * p.y());
  mesh.positions.emplace_back(7.0, 8.0, 9.0);  // loose
  const VertexSet region = vertices_where(mesh, in_middle);
  for (const double length : {0.1, 0.05, 0.02}) {
    const RemeshResult result = remesh_isotropic(mesh, region, everywhere(length));
    expect_outside_unchanged(mesh, region, result);
    EXPECT_EQ(shape_of(result.mesh), shape_of(mesh)) << "conforming, or edges would be open";
    EXPECT_TRUE(std::ranges::find(result.kept, mesh.vertex_count() - 1) != result.kept.end());
  }
}

TEST(RemeshIsotropic, RegionOfTheResultIsThePatchAndItsBorder) {
  const Mesh mesh = quad_grid(20);
  const VertexSet region = vertices_where(mesh, in_middle);
  const RemeshResult result = remesh_isotropic(mesh, region, everywhere(0.04));
  const RegionQuality before = region_quality(mesh, region);
  const RegionQuality after = region_quality(result.mesh, result.region);
  EXPECT_EQ(result.mesh.face_count() - after.faces, mesh.face_count() - before.faces);
  EXPECT_EQ(after.vertices, result.region.size());
  for (Index v = 0; v < result.kept.size(); ++v) {
    if (result.kept[v] != kNoIndex) continue;
    EXPECT_TRUE(std::ranges::binary_search(result.region, v)) << "made outside the region";
  }
}

TEST(RemeshIsotropic, KeepsTheBoundaryOfAnOpenMesh) {
  const Mesh tube = cylinder(30, 20, 0.5, 2.0);
  const RemeshResult result = remesh_all(tube, 0.08);
  EXPECT_EQ(shape_of(result.mesh), shape_of(tube));
  const auto at_ends = [](const Vector3d& p) { return p.z() == 0.0 || p.z() == 2.0; };
  std::size_t kept = 0;
  for (Index v = 0; v < result.kept.size(); ++v) {
    if (result.kept[v] == kNoIndex) continue;
    EXPECT_TRUE(at_ends(tube.positions[result.kept[v]]));
    EXPECT_EQ(result.mesh.positions[v], tube.positions[result.kept[v]]);
    ++kept;
  }
  EXPECT_EQ(kept, 60U);
}

TEST(RemeshIsotropic, KeepsHandlesAndHoles) {
  const Mesh mesh = torus(40, 20, 1.0, 0.4);
  for (const double length : {0.3, 0.1, 0.06}) {
    const RemeshResult result = remesh_all(mesh, length);
    EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
    EXPECT_GE(share_of_good_edges(result.mesh, everywhere(length)), 0.97);
  }
}

TEST(RemeshIsotropic, FollowsAGradedLength) {
  const Mesh mesh = grid(24, 24);
  const auto length = [](const Vector3d& p) { return 0.02 + 0.04 * p.x(); };
  const RemeshResult result = remesh_isotropic(mesh, every_vertex(mesh), length);
  EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
  EXPECT_GE(share_of_good_edges(result.mesh, length), 0.95);
  EXPECT_GE(region_quality(result.mesh, result.region).smallest_angle_degrees, 20.0);
}

TEST(RemeshIsotropic, TurnsGraduallyFromALongBorderToAShortLength) {
  const Mesh mesh = grid(4, 4);
  const RemeshResult result = remesh_all(mesh, 0.02);
  EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
  EXPECT_GE(region_quality(result.mesh, result.region).smallest_angle_degrees, 10.0);
}

TEST(RemeshIsotropic, ScalesWithTheMesh) {
  const Mesh mesh = bumpy_plane(24, 3, 0.1);
  Mesh larger = mesh;
  for (Vector3d& p : larger.positions) p *= 4.0;
  const Mesh a = remesh_all(mesh, 0.0625).mesh;
  const Mesh b = remesh_all(larger, 0.25).mesh;
  EXPECT_EQ(a.face_vertices(), b.face_vertices());
  for (std::size_t v = 0; v < a.vertex_count(); ++v) {
    ASSERT_EQ(4.0 * a.positions[v], b.positions[v]) << "vertex " << v;
  }
}

TEST(RemeshIsotropic, GivesTheSameBitsTwice) {
  const Mesh mesh = torus(40, 20, 1.0, 0.4);
  const RemeshResult a = remesh_all(mesh, 0.09);
  const RemeshResult b = remesh_all(mesh, 0.09);
  EXPECT_EQ(a.mesh.positions, b.mesh.positions);
  EXPECT_EQ(a.mesh.face_vertices(), b.mesh.face_vertices());
}

TEST(RemeshIsotropic, ReportsItsProgressAndCanBeCancelled) {
  const Mesh mesh = icosphere(3);
  double last = -1.0;
  const auto watch = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "remesh");
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  };
  remesh_isotropic(mesh, every_vertex(mesh), everywhere(0.2), {}, watch);
  EXPECT_EQ(last, 1.0);
  const auto stop = [](std::string_view, double fraction) { return fraction < 0.5; };
  EXPECT_THROW(remesh_isotropic(mesh, every_vertex(mesh), everywhere(0.2), {}, stop), Cancelled);
}

}  // namespace
}  // namespace lapwing
