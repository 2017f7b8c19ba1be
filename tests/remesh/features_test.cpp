// Lines that remeshing keeps: sharp edges, and those between materials, groups and charts.
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "remesh/remesh_checks.h"

namespace lapwing {
namespace {

using namespace test;
using Eigen::Vector3d;

Mesh unit_cube() {
  return bar(6, 6, 1.0, 1.0);  // x and y from -0.5 to 0.5, z from 0 to 1
}

// On how many of the cube's planes the point is.
int planes_at(const Vector3d& p) {
  return (std::abs(std::abs(p.x()) - 0.5) < 1e-12) + (std::abs(std::abs(p.y()) - 0.5) < 1e-12) +
         (std::abs(p.z()) < 1e-12) + (std::abs(p.z() - 1.0) < 1e-12);
}

// The summed length of edges between faces of different labels.
double border_length(const Mesh& mesh, const std::vector<Index>& label) {
  const Edges edges = build_edges(mesh);
  double sum = 0.0;
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto sides = edges.sides[e];
    if (sides.size() != 2) continue;
    if (label[edges.face_of_corner[sides[0]]] == label[edges.face_of_corner[sides[1]]]) continue;
    const auto [a, b] = edges.ends[e];
    sum += (mesh.positions[a] - mesh.positions[b]).norm();
  }
  return sum;
}

std::map<Index, double> area_by(const Mesh& mesh, const std::vector<Index>& label) {
  std::map<Index, double> areas;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    areas[label[f]] += area_vector(mesh, f).norm();
  }
  return areas;
}

class RemeshCube : public ::testing::TestWithParam<double> {};

TEST_P(RemeshCube, KeepsItsVolumeEdgesAndCorners) {
  const RemeshResult result = remesh_all(unit_cube(), GetParam());
  EXPECT_EQ(shape_of(result.mesh), shape_of(unit_cube()));
  EXPECT_NEAR(volume(result.mesh), 1.0, 1e-12);
  EXPECT_NEAR(area(result.mesh), 6.0, 1e-12);
  std::array<int, 4> by_planes{};
  for (const Vector3d& p : result.mesh.positions)
    ++by_planes[static_cast<std::size_t>(planes_at(p))];
  EXPECT_EQ(by_planes[0], 0) << "off the surface";
  EXPECT_EQ(by_planes[3], 8) << "corners";
  EXPECT_NEAR(by_planes[2], 12.0 * (1.0 / GetParam() - 1.0), 4.0 / GetParam()) << "on edges";
  EXPECT_GE(share_of_good_edges(result.mesh, everywhere(GetParam())), 0.95);
}

INSTANTIATE_TEST_SUITE_P(CoarserAndFiner, RemeshCube, ::testing::Values(0.5, 0.2, 0.1, 0.05));

TEST(RemeshFeatures, LargeFeatureAngleRoundsTheCube) {
  RemeshOptions options;
  options.feature_angle_degrees = 100.0;
  EXPECT_LT(volume(remesh_all(unit_cube(), 0.3, options).mesh), 0.9999);
}

// A round spot of another material in the middle of a plane, with a jagged edge.
Mesh spotted_plane(Index cells) {
  Mesh mesh = grid(cells, cells);
  mesh.edit_attributes().materials = {"wood", "steel"};
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Vector3d center = Vector3d::Zero();
    for (const Index v : mesh.face(f)) center += mesh.positions[v] / 3.0;
    const bool spot = (center - Vector3d(0.5, 0.5, 0.0)).norm() < 0.25;
    mesh.edit_attributes().face_materials.push_back(spot ? 1 : 0);
  }
  return mesh;
}

TEST(RemeshFeatures, MaterialLineStaysWhereTrianglesAreFiner) {
  const Mesh mesh = spotted_plane(20);
  const RemeshResult result = remesh_all(mesh, 0.025);
  const auto& before = mesh.attributes().face_materials;
  const auto& after = result.mesh.attributes().face_materials;
  ASSERT_EQ(after.size(), result.mesh.face_count());
  EXPECT_NEAR(area_by(result.mesh, after)[1], area_by(mesh, before)[1], 1e-12);
  EXPECT_NEAR(border_length(result.mesh, after), border_length(mesh, before), 1e-12);
}

TEST(RemeshFeatures, MaterialLineStaysWithinATenthOfTheLengthWhereTheyAreCoarser) {
  const Mesh mesh = spotted_plane(40);
  const RemeshResult result = remesh_all(mesh, 0.1);
  const double around = 2.0 * 0.25 * 3.1416;
  EXPECT_NEAR(area_by(result.mesh, result.mesh.attributes().face_materials)[1],
              area_by(mesh, mesh.attributes().face_materials)[1], 0.1 * 0.1 * around);
  EXPECT_LT(result.mesh.face_count(), mesh.face_count() / 2);
}

TEST(RemeshFeatures, ToothInALineIsCutByAboutATenthOfTheLengthAtMost) {
  // A line along y = 0.5 with a tooth of height 0.04 between x = 0.45 and 0.55.
  Mesh mesh = grid(20, 20);
  mesh.positions[10 * 21 + 10].y() += 0.04;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    mesh.edit_attributes().face_groups.push_back(f < mesh.face_count() / 2 ? 0 : 1);
  }
  mesh.edit_attributes().groups = {"below", "above"};
  const Mesh result = remesh_all(mesh, 0.2).mesh;
  const auto& groups = result.attributes().face_groups;
  const auto distance = [](const Vector3d& p, const Vector3d& a, const Vector3d& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (a + t * (b - a) - p).norm();
  };
  const std::array<Vector3d, 5> line{Vector3d(0, 0.5, 0), Vector3d(0.45, 0.5, 0),
                                     Vector3d(0.5, 0.54, 0), Vector3d(0.55, 0.5, 0),
                                     Vector3d(1, 0.5, 0)};
  const Edges edges = build_edges(result);
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const auto sides = edges.sides[e];
    if (sides.size() != 2) continue;
    if (groups[edges.face_of_corner[sides[0]]] == groups[edges.face_of_corner[sides[1]]]) continue;
    const auto [a, b] = edges.ends[e];
    for (const double t : {0.0, 0.2, 0.4, 0.5, 0.6, 0.8, 1.0}) {
      const Vector3d p = result.positions[a] + t * (result.positions[b] - result.positions[a]);
      double nearest = 1.0;
      for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        nearest = std::min(nearest, distance(p, line[k], line[k + 1]));
      }
      EXPECT_LE(nearest, 0.13 * 0.2) << p.transpose();  // between the samples it looks at
    }
  }
}

TEST(RemeshFeatures, SquareSpotKeepsItsCorners) {
  Mesh mesh = grid(20, 20);
  mesh.edit_attributes().groups = {"square"};
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Vector3d center = Vector3d::Zero();
    for (const Index v : mesh.face(f)) center += mesh.positions[v] / 3.0;
    const bool spot = (center - Vector3d(0.5, 0.5, 0.0)).cwiseAbs().maxCoeff() < 0.25;
    mesh.edit_attributes().face_groups.push_back(spot ? 0 : kNoIndex);
  }
  for (const double length : {0.02, 0.1}) {
    const RemeshResult result = remesh_all(mesh, length);
    const auto& groups = result.mesh.attributes().face_groups;
    EXPECT_NEAR(area_by(result.mesh, groups)[0], 0.25, 1e-12);
    EXPECT_NEAR(border_length(result.mesh, groups), 2.0, 1e-12);
    const auto& points = result.mesh.positions;
    EXPECT_NE(std::ranges::find(points, Vector3d(0.25, 0.25, 0.0)), points.end());
  }
}

// A roof whose sides meet at the middle at 20 degrees, with a normal of its own on each side.
Mesh shaded_roof(Index cells) {
  Mesh mesh = grid(cells, cells);
  MeshAttributes& a = mesh.edit_attributes();
  const double slope = std::tan(10.0 * 3.14159265 / 180.0);
  a.normals = {Vector3d(-slope, 0, 1).normalized(), Vector3d(slope, 0, 1).normalized()};
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    double x = 0.0;
    for (const Index v : mesh.face(f)) x += mesh.positions[v].x() / 3.0;
    a.corner_normals.insert(a.corner_normals.end(), 3, x < 0.5 ? 0 : 1);
  }
  for (Vector3d& p : mesh.positions) p.z() = slope * (0.5 - std::abs(p.x() - 0.5));
  return mesh;
}

TEST(RemeshFeatures, EdgesWithTwoStoredNormalsAreKeptBelowTheFeatureAngleToo) {
  const Mesh mesh = shaded_roof(20);
  const Mesh result = remesh_all(mesh, 0.08).mesh;
  EXPECT_NEAR(area(result), area(mesh), 1e-12);
  const MeshAttributes& a = result.attributes();
  for (std::size_t c = 0; c < a.corner_normals.size(); ++c) {
    const Vector3d normal = area_vector(result, c / 3).normalized();
    ASSERT_LT((a.normals[a.corner_normals[c]] - normal).norm(), 1e-7);
  }
}

TEST(RemeshFeatures, FlatShadingMakesNoFeatures) {
  Mesh sphere = icosphere(3);
  for (std::size_t f = 0; f < sphere.face_count(); ++f) {
    sphere.edit_attributes().normals.push_back(area_vector(sphere, f).normalized());
    sphere.edit_attributes().corner_normals.insert(sphere.attributes().corner_normals.end(), 3,
                                                   static_cast<Index>(f));
  }
  const RemeshResult result = remesh_all(sphere, 0.3);
  EXPECT_LT(result.mesh.face_count(), sphere.face_count() / 2);
}

TEST(RemeshFeatures, DiagonalsOfPolygonsAreNoFeatures) {
  // Squares that are folded along their diagonals by more than the feature angle.
  Mesh mesh;
  for (int r = 0; r < 9; ++r) {
    for (int c = 0; c < 9; ++c) mesh.positions.emplace_back(c, r, (r + c) % 2 == 0 ? 0.45 : 0.0);
  }
  for (Index r = 0; r < 8; ++r) {
    for (Index c = 0; c < 8; ++c) {
      const Index v = 9 * r + c;
      mesh.add_face(std::array{v, v + 1, v + 10, v + 9});
    }
  }
  RemeshOptions options;
  options.feature_angle_degrees = 60.0;
  const RemeshResult result = remesh_all(mesh, 1.0, options);
  EXPECT_EQ(shape_of(result.mesh), shape_of(mesh));
  EXPECT_LT(result.mesh.vertex_count(), 4U * mesh.vertex_count());
}

}  // namespace
}  // namespace lapwing
