// Input that is broken, degenerate or unusual: a message that names vertices, or the right result.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "remesh/remesh_checks.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using namespace test;
using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string refusal(const Mesh& mesh, double length = 0.1, const RemeshOptions& options = {}) {
  return error_message<InputError>([&] { remesh_all(mesh, length, options); });
}

TEST(RemeshRefuses, PositionsThatAreNotFinite) {
  Mesh mesh = grid(4, 4);
  mesh.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(mesh), HasSubstr("vertex 7"));
}

TEST(RemeshIsotropic, DoesNotMindPositionsOutsideThatAreNotFinite) {
  Mesh mesh = grid(8, 8);
  mesh.positions[0].y() = std::numeric_limits<double>::infinity();
  const VertexSet region = vertices_where(mesh, [](const Vector3d& p) { return p.x() > 0.4; });
  const RemeshResult result = remesh_isotropic(mesh, region, everywhere(0.06));
  EXPECT_GT(result.mesh.face_count(), mesh.face_count());
}

TEST(RemeshRefuses, AnEdgeWithThreeTriangles) {
  Mesh mesh = grid(4, 4);
  mesh.positions.emplace_back(0.5, 0.5, 1.0);
  mesh.add_face(std::array<Index, 3>{6, 7, 25});
  EXPECT_THAT(refusal(mesh), AllOf(HasSubstr("vertices 6, 7"), HasSubstr("3 triangles")));
}

TEST(RemeshRefuses, FacesThatLookToOppositeSides) {
  Mesh mesh = grid(4, 4);
  std::swap(mesh.edit_faces().vertices[0], mesh.edit_faces().vertices[1]);
  EXPECT_THAT(refusal(mesh), AllOf(HasSubstr("opposite orientations"), HasSubstr("check --fix")));
}

TEST(RemeshRefuses, SurfacesThatTouchAtAVertex) {
  Mesh mesh = icosphere(1);
  const auto count = static_cast<Index>(mesh.vertex_count());
  const Mesh other = mesh;
  for (const Vector3d& p : other.positions) mesh.positions.emplace_back(p + Vector3d(0, 0, 2));
  for (std::size_t f = 0; f < other.face_count(); ++f) {
    std::vector<Index> face;
    for (const Index v : other.face(f)) face.push_back(v == 5 ? 2 : v + count);
    mesh.add_face(face);
  }
  EXPECT_THAT(refusal(mesh), AllOf(HasSubstr("vertex 2"), HasSubstr("touch")));
}

TEST(RemeshRefuses, ArgumentsThatMeanNothing) {
  const Mesh mesh = grid(4, 4);
  for (const double length : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(refusal(mesh, length), HasSubstr("must be positive"));
  }
  const VertexSet region{3, 25};
  EXPECT_THAT(error_message<InputError>([&] { remesh_isotropic(mesh, region, everywhere(0.1)); }),
              HasSubstr("vertex 25"));
  EXPECT_THAT(refusal(mesh, 1e-9), HasSubstr("greater length"));
  EXPECT_THAT(refusal(mesh, 0.1, {.iterations = -1}), HasSubstr("iterations"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(mesh, 0.1, {.feature_angle_degrees = nan}), HasSubstr("feature angle"));
}

TEST(RemeshIsotropic, SaysWhenTheRegionHoldsNoFace) {
  const Mesh mesh = grid(4, 4);
  const RemeshResult result = remesh_isotropic(mesh, {3, 17}, everywhere(0.1));
  EXPECT_THAT(result.note, HasSubstr("nothing was remeshed"));
  EXPECT_EQ(result.mesh.face_vertices(), mesh.face_vertices());
  EXPECT_EQ(result.kept, every_vertex(mesh));
}

TEST(RemeshIsotropic, RegionMayTouchItselfAtAVertex) {
  const Mesh mesh = grid(12, 12);
  // Two quarters of the plane that meet in its middle only.
  const VertexSet region = vertices_where(
      mesh, [](const Vector3d& p) { return (p.x() <= 0.5) == (p.y() <= 0.5) || p.x() == 0.5; });
  for (const double length : {0.04, 0.15}) {
    const RemeshResult result = remesh_isotropic(mesh, region, everywhere(length));
    EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
    EXPECT_NEAR(area(result.mesh), 1.0, 1e-12);
    expect_outside_unchanged(mesh, region, result);
  }
}

TEST(RemeshIsotropic, JoinsNoBorderVerticesThatAreJoinedOutside) {
  // A low roof over a rhombus whose short diagonal is an edge of the floor, which is outside.
  Mesh house;
  house.positions = {{-0.5, 0, 0}, {0.5, 0, 0},      {0, -1, 0},     {0, 1, 0},
                     {0, 0, 0.3},  {0, -0.4, -0.05}, {0, 0.4, -0.05}};
  for (const Triangle& t :
       {Triangle{0, 2, 4}, Triangle{2, 1, 4}, Triangle{1, 3, 4}, Triangle{3, 0, 4},
        Triangle{0, 1, 5}, Triangle{1, 2, 5}, Triangle{2, 0, 5}, Triangle{0, 3, 6},
        Triangle{3, 1, 6}, Triangle{1, 0, 6}}) {
    house.add_face(t);
  }
  const VertexSet roof{0, 1, 2, 3, 4};
  ASSERT_EQ(shape_of(house).non_manifold, 0U);
  for (const double length : {0.3, 5.0}) {
    const RemeshResult result =
        remesh_isotropic(house, roof, everywhere(length), {.feature_angle_degrees = 120.0});
    EXPECT_EQ(shape_of(result.mesh), shape_of(house));
    expect_outside_unchanged(house, roof, result);
  }
}

TEST(RemeshIsotropic, NarrowBandBetweenTwoBordersStaysConforming) {
  // Around a tube, each of its triangles with all corners on the border.
  const Mesh tube = cylinder(5, 8, 0.5, 2.0);
  const double rise = 2.0 / 7.0;
  const VertexSet region = vertices_where(
      tube, [&](const Vector3d& p) { return p.z() > 2.5 * rise && p.z() < 4.5 * rise; });
  for (const double length : {0.1, 0.3, 2.0}) {
    const RemeshResult result = remesh_isotropic(tube, region, everywhere(length));
    EXPECT_EQ(shape_of(result.mesh), shape_of(tube));
    expect_outside_unchanged(tube, region, result);
  }
}

TEST(RemeshIsotropic, VertexUsedByAFaceOutsideStays) {
  Mesh mesh = grid(8, 8);
  const Index middle = 4 * 9 + 4;
  mesh.positions.emplace_back(0.4, 0.5, 1.0);
  mesh.positions.emplace_back(0.6, 0.5, 1.0);
  mesh.add_face(std::array{middle, Index{81}, Index{82}});
  VertexSet region = every_vertex(mesh);
  region.resize(81);
  for (const double length : {0.04, 0.4}) {
    const RemeshResult result = remesh_isotropic(mesh, region, everywhere(length));
    expect_outside_unchanged(mesh, region, result);
    EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
  }
}

TEST(RemeshIsotropic, MendsTrianglesWithoutArea) {
  // Vertices moved onto neighbours and onto edges.
  Mesh mesh = grid(10, 10);
  mesh.positions[3 * 11 + 3] = mesh.positions[3 * 11 + 4];
  mesh.positions[6 * 11 + 6] = 0.5 * (mesh.positions[5 * 11 + 6] + mesh.positions[6 * 11 + 5]);
  const RemeshResult result = remesh_all(mesh, 0.08);
  EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
  EXPECT_NEAR(area(result.mesh), 1.0, 1e-12);
  for (std::size_t f = 0; f < result.mesh.face_count(); ++f) {
    ASSERT_GT(area_vector(result.mesh, f).z(), 1e-4) << "face " << f;
  }
}

TEST(RemeshIsotropic, DropsFacesThatNameAVertexTwice) {
  Mesh mesh = grid(6, 6);
  mesh.add_face(std::array<Index, 3>{8, 8, 9});
  const RemeshResult result = remesh_all(mesh, 0.1);
  EXPECT_NEAR(area(result.mesh), 1.0, 1e-12);
  EXPECT_EQ(shape_of(result.mesh).non_manifold, 0U);
}

TEST(RemeshIsotropic, EndsWhenAllPointsAreOne) {
  Mesh mesh = icosphere(2);
  std::ranges::fill(mesh.positions, Vector3d(1, 2, 3));
  const RemeshResult result = remesh_all(mesh, 0.1);
  for (const Vector3d& p : result.mesh.positions) EXPECT_EQ(p, Vector3d(1, 2, 3));
  EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
}

TEST(RemeshIsotropic, CoarsensASphereNoFurtherThanItsTopologyAllows) {
  const Mesh sphere = icosphere(2);
  const RemeshResult result = remesh_all(sphere, 50.0);
  EXPECT_EQ(shape_of(result.mesh), shape_of(sphere));
  EXPECT_GE(result.mesh.face_count(), 4U);
  EXPECT_GT(volume(result.mesh), 0.0);
}

TEST(RemeshIsotropic, EndsForLengthsThatJump) {
  const Mesh mesh = grid(8, 8);
  const auto length = [](const Vector3d& p) {
    return std::fmod(p.x(), 0.25) == 0.0 && std::fmod(p.y(), 0.25) == 0.0 ? 1.0 : 0.02;
  };
  const RemeshResult result = remesh_isotropic(mesh, every_vertex(mesh), length);
  EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
  EXPECT_NEAR(area(result.mesh), 1.0, 1e-12);
}

}  // namespace
}  // namespace lapwing
