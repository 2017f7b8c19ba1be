#include "lapwing/doctor/fix.h"

#include <array>
#include <limits>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "doctor/broken_meshes.h"
#include "lapwing/base/errors.h"
#include "lapwing/doctor/check.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/topology.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

double signed_volume(const Mesh& mesh) {
  double volume = 0.0;
  for (const Triangle& t : mesh.topology().triangles) {
    volume += mesh.positions[t[0]].dot(mesh.positions[t[1]].cross(mesh.positions[t[2]])) / 6.0;
  }
  return volume;
}

void flip(Mesh& mesh, std::size_t face) {
  Faces& faces = mesh.edit_faces();
  std::swap(faces.vertices[faces.starts[face]], faces.vertices[faces.starts[face] + 1]);
}

TEST(Fix, CleanMeshStaysAsItIs) {
  for (Mesh mesh : {icosphere(1), grid(3, 2), moebius_strip(), three_winged_edge()}) {
    const Mesh before = mesh;
    const FixReport report = fix(mesh);
    EXPECT_FALSE(report.changed());
    EXPECT_EQ(mesh.positions, before.positions);
    EXPECT_EQ(mesh.face_vertices(), before.face_vertices());
    EXPECT_EQ(report.vertex_sources.size(), mesh.vertex_count());
  }
}

TEST(Fix, WeldsASeamAndKeepsUvsAndMaterials) {
  Mesh mesh = unwelded_square();
  mesh.edit_attributes().uvs.assign(6, Eigen::Vector2d::Zero());
  mesh.edit_attributes().corner_uvs = {5, 4, 3, 2, 1, 0};
  mesh.edit_attributes().materials = {"wood", "steel"};
  mesh.edit_attributes().face_materials = {1, 0};
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::welded_vertices), 2U);
  EXPECT_THAT(mesh.face(0), ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.face(1), ElementsAre(2, 1, 3));
  EXPECT_EQ(mesh.positions[3], Eigen::Vector3d(1, 1, 0));
  EXPECT_THAT(report.vertex_sources, ElementsAre(0, 1, 2, 5));
  EXPECT_THAT(mesh.attributes().corner_uvs, ElementsAre(5, 4, 3, 2, 1, 0));
  EXPECT_THAT(mesh.attributes().face_materials, ElementsAre(1, 0));
}

TEST(Fix, SaysWhenWeldedVerticesDiffered) {
  Mesh mesh = unwelded_square();
  mesh.edit_attributes().vertex_extras = {{"s", "float", 1, {0, 1, 2, 2, 8, 5}}};
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::welded_unlike_vertices), 1U);
  EXPECT_THAT(mesh.attributes().vertex_extras[0].values, ElementsAre(0, 1, 2, 5));
}

TEST(Fix, WeldsATriangleSoupIntoTheSphereItCameFrom) {
  const Mesh sphere = icosphere(2);
  Mesh soup;
  for (const Index v : sphere.face_vertices()) soup.positions.push_back(sphere.positions[v]);
  for (Index c = 0; c < sphere.face_vertices().size(); c += 3) add_polygon(soup, {c, c + 1, c + 2});
  fix(soup);
  EXPECT_EQ(soup.vertex_count(), sphere.vertex_count());
  EXPECT_THAT(check(soup).defects, IsEmpty());
}

TEST(Fix, WeldsTheCutOfATubeThatWasUnrolled) {
  Mesh mesh = grid(6, 2);
  for (Eigen::Vector3d& p : mesh.positions) {
    const double angle = p.x() == 1.0 ? 0.0 : 6.28 * p.x();
    p = {std::cos(angle), std::sin(angle), p.y()};
  }
  fix(mesh);
  const CheckReport report = check(mesh);
  EXPECT_FALSE(report.has_problems());
  EXPECT_EQ(report.statistics.boundary_loops, 2U);
}

TEST(Fix, RemovesNonFiniteVerticesWithTheirFaces) {
  Mesh mesh = grid(2, 2);
  mesh.positions[8].y() = std::numeric_limits<double>::infinity();
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::removed_non_finite_vertices), 1U);
  EXPECT_EQ(report.count(RepairKind::removed_non_finite_faces), 2U);
  EXPECT_EQ(mesh.vertex_count(), 8U);
  EXPECT_EQ(mesh.face_count(), 6U);
}

TEST(Fix, RemovesLooseVertices) {
  Mesh mesh = grid(1, 1);
  mesh.positions.insert(mesh.positions.begin(), Eigen::Vector3d(5, 5, 5));
  for (Index& v : mesh.edit_faces().vertices) ++v;
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::removed_loose_vertices), 1U);
  EXPECT_EQ(mesh.face_vertices(), grid(1, 1).face_vertices());
}

TEST(Fix, RemovesRepeatedAndDegenerateFaces) {
  Mesh mesh = grid(1, 1);
  add_polygon(mesh, {mesh.face(0)[2], mesh.face(0)[1], mesh.face(0)[0]});
  add_polygon(mesh, {1, 1, 2});
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::removed_repeated_faces), 1U);
  EXPECT_EQ(report.count(RepairKind::removed_degenerate_faces), 1U);
  EXPECT_EQ(mesh.face_vertices(), grid(1, 1).face_vertices());
}

TEST(Fix, CollapsedQuadBecomesATriangleWithItsOwnUvs) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  add_polygon(mesh, {0, 1, 1, 2});
  mesh.edit_attributes().uvs.assign(4, Eigen::Vector2d::Zero());
  mesh.edit_attributes().corner_uvs = {0, 1, 2, 3};
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::mended_faces), 1U);
  EXPECT_THAT(mesh.face(0), ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.attributes().corner_uvs, ElementsAre(0, 1, 3));
}

TEST(Fix, PolygonWithABridgedHoleKeepsItsSurface) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0},
                    {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
  add_polygon(mesh, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4});
  fix(mesh);
  const CheckReport report = check(mesh);
  EXPECT_DOUBLE_EQ(report.statistics.area, 8.0);
  EXPECT_EQ(report.statistics.boundary_loops, 2U);
  EXPECT_FALSE(report.is_fixable());
}

TEST(Fix, GivesEachFanOfABowTieItsVertex) {
  Mesh mesh = bow_tie();
  mesh.edit_attributes().vertex_colors.assign(5, Eigen::Vector4f::Ones());
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::split_bow_ties), 1U);
  EXPECT_THAT(mesh.face(0), ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.face(1), ElementsAre(5, 3, 4));
  EXPECT_EQ(mesh.positions[5], mesh.positions[0]);
  EXPECT_EQ(mesh.attributes().vertex_colors.size(), 6U);
  EXPECT_EQ(report.vertex_sources[5], 0U);
}

TEST(Fix, ClosedSurfaceEndsUpOutwardWhateverWasFlipped) {
  for (const std::size_t step : {1U, 2U, 3U}) {
    Mesh mesh = icosphere(1);
    const double volume = signed_volume(mesh);
    for (std::size_t f = step - 1; f < mesh.face_count() - 1; f += step) flip(mesh, f);
    EXPECT_TRUE(fix(mesh).changed());
    EXPECT_DOUBLE_EQ(signed_volume(mesh), volume);
    EXPECT_THAT(check(mesh).defects, IsEmpty());
  }
}

TEST(Fix, OpenSurfaceFlipsTheSmallerPart) {
  Mesh mesh = grid(4, 4);
  const std::vector<Index> before = mesh.face_vertices();
  flip(mesh, 0);
  flip(mesh, 9);
  const FixReport report = fix(mesh);
  EXPECT_EQ(report.count(RepairKind::flipped_faces), 2U);
  EXPECT_EQ(check(mesh).find(DefectKind::inconsistent_orientation), nullptr);
  EXPECT_TRUE(std::equal(mesh.face(20).begin(), mesh.face(20).end(), before.begin() + 60));
}

TEST(Fix, FlippedFaceTakesItsCornersAttributesAlong) {
  Mesh mesh = grid(2, 2);
  mesh.edit_attributes().uvs.assign(9, Eigen::Vector2d::Zero());
  flip(mesh, 3);
  mesh.edit_attributes().corner_uvs = mesh.face_vertices();
  fix(mesh);
  EXPECT_EQ(mesh.attributes().corner_uvs, mesh.face_vertices());
}

TEST(Fix, RefusesToLeaveNothingAndSaysWhy) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  add_polygon(mesh, {0, 1, 0});
  EXPECT_THAT(error_message<InputError>([&] { fix(mesh); }),
              ::testing::HasSubstr("none of its faces has three different, finite vertices"));
  EXPECT_EQ(mesh.vertex_count(), 3U);
  EXPECT_EQ(mesh.face_count(), 1U);
}

TEST(Fix, EmptyMeshHasNothingToRepair) {
  Mesh mesh;
  EXPECT_FALSE(fix(mesh).changed());
}

}  // namespace
}  // namespace lapwing
