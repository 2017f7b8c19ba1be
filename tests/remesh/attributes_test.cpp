// What the new vertices, corners and faces carry.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"
#include "remesh/remesh_checks.h"

namespace lapwing {
namespace {

using namespace test;
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d planar_map(const Vector3d& p) {
  return {0.3 + 0.5 * p.x() - 0.2 * p.y(), 0.1 * p.x() + 0.7 * p.y()};
}

Eigen::Vector4f linear_color(const Vector3d& p) {
  return Eigen::Vector4d(p.x(), p.y(), 0.5 * p.x() + 0.5 * p.y(), 1.0).cast<float>();
}

// A plane with one of everything, each a linear function of the position.
Mesh rich_plane(Index cells) {
  Mesh mesh = grid(cells, cells);
  MeshAttributes& a = mesh.edit_attributes();
  for (const Vector3d& p : mesh.positions) {
    a.uvs.push_back(planar_map(p));
    a.vertex_colors.push_back(linear_color(p));
    a.normals.push_back(Vector3d::UnitZ());
  }
  a.corner_uvs = mesh.face_vertices();
  a.has_vertex_normals = true;
  a.vertex_extras = {{"height", "float", 1, {}}, {"flags", "uchar", 1, {}}};
  for (const Vector3d& p : mesh.positions) {
    a.vertex_extras[0].values.push_back(3.0 * p.x() - p.y());
    a.vertex_extras[1].values.push_back(p.x() < 0.5 ? 4.0 : 64.0);
  }
  a.materials = {"left", "right"};
  a.face_extras = {{"side", "int", 1, {}}};
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    Vector3d center = Vector3d::Zero();
    for (const Index v : mesh.face(f)) center += mesh.positions[v] / 3.0;
    const bool right = center.x() > 0.5;
    a.face_materials.push_back(right);
    a.face_colors.emplace_back(right ? 1.0F : 0.0F, 0.0F, 0.0F, 1.0F);
    a.face_extras[0].values.push_back(right ? 7.0 : 3.0);
  }
  return mesh;
}

TEST(RemeshAttributes, LinearFunctionsOnAPlaneAreReproduced) {
  for (const double length : {0.03, 0.12}) {
    const Mesh result = remesh_all(rich_plane(16), length).mesh;
    const MeshAttributes& a = result.attributes();
    ASSERT_EQ(a.vertex_colors.size(), result.vertex_count());
    for (std::size_t v = 0; v < result.vertex_count(); ++v) {
      const Vector3d& p = result.positions[v];
      ASSERT_LT((a.vertex_colors[v] - linear_color(p)).norm(), 1e-6F);
      ASSERT_NEAR(a.vertex_extras[0].values[v], 3.0 * p.x() - p.y(), 1e-13);
      const double flag = a.vertex_extras[1].values[v];
      ASSERT_TRUE(flag == 4.0 || flag == 64.0) << flag;
      ASSERT_EQ(a.normals[v], Vector3d::UnitZ());
    }
    ASSERT_EQ(a.corner_uvs.size(), result.face_vertices().size());
    for (std::size_t c = 0; c < a.corner_uvs.size(); ++c) {
      const Vector2d wanted = planar_map(result.positions[result.face_vertices()[c]]);
      ASSERT_LT((a.uvs[a.corner_uvs[c]] - wanted).norm(), 1e-14);
    }
  }
}

TEST(RemeshAttributes, FacesTakeThoseOfTheFaceTheyLieOn) {
  const Mesh result = remesh_all(rich_plane(16), 0.04).mesh;
  const MeshAttributes& a = result.attributes();
  ASSERT_EQ(a.face_materials.size(), result.face_count());
  for (std::size_t f = 0; f < result.face_count(); ++f) {
    Vector3d center = Vector3d::Zero();
    for (const Index v : result.face(f)) center += result.positions[v] / 3.0;
    const bool right = center.x() > 0.5;
    ASSERT_EQ(a.face_materials[f], right ? 1U : 0U);
    ASSERT_EQ(a.face_colors[f].x(), right ? 1.0F : 0.0F);
    ASSERT_EQ(a.face_extras[0].values[f], right ? 7.0 : 3.0);
  }
}

TEST(RemeshAttributes, StayBitForBitOutside) {
  const Mesh mesh = rich_plane(16);
  const VertexSet region =
      vertices_where(mesh, [](const Vector3d& p) { return p.x() > 0.2 && p.y() < 0.7; });
  const RemeshResult result = remesh_isotropic(mesh, region, everywhere(0.04));
  expect_outside_unchanged(mesh, region, result);
  const MeshAttributes& now = result.mesh.attributes();
  const MeshAttributes& was = mesh.attributes();
  for (std::size_t v = 0; v < result.kept.size(); ++v) {
    if (result.kept[v] == kNoIndex) continue;
    EXPECT_EQ(now.vertex_colors[v], was.vertex_colors[result.kept[v]]);
    EXPECT_EQ(now.vertex_extras[0].values[v], was.vertex_extras[0].values[result.kept[v]]);
  }
  const std::vector<char> inside = vertex_mask(mesh.vertex_count(), region);
  std::size_t next = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (std::ranges::all_of(mesh.face(f), [&](Index v) { return inside[v] != 0; })) continue;
    EXPECT_EQ(now.face_materials[next], was.face_materials[f]);
    EXPECT_EQ(now.face_colors[next], was.face_colors[f]);
    for (Index k = 0; k < 3; ++k) {
      EXPECT_EQ(now.uvs[now.corner_uvs[3 * next + k]], was.uvs[was.corner_uvs[3 * f + k]]);
    }
    ++next;
  }
}

// A tube whose texture is cut open along one line of edges: one chart on both sides of its seam.
Mesh cut_tube(Index around, Index along) {
  const Mesh flat = grid(around, along);
  Mesh mesh;
  for (Index r = 0; r <= along; ++r) {
    for (Index c = 0; c < around; ++c) {
      const double angle = 2.0 * std::numbers::pi * c / around;
      mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 3.0 * r / along);
    }
  }
  for (std::size_t f = 0; f < flat.face_count(); ++f) {
    std::vector<Index> face;
    for (const Index v : flat.face(f)) {
      face.push_back(v / (around + 1) * around + v % (around + 1) % around);
    }
    mesh.add_face(face);
  }
  for (const Vector3d& p : flat.positions) mesh.edit_attributes().uvs.emplace_back(p.head<2>());
  mesh.edit_attributes().corner_uvs = flat.face_vertices();
  return mesh;
}

TEST(RemeshAttributes, TextureStaysABijectionUpToItsSeam) {
  const Mesh tube = cut_tube(40, 20);
  for (const double length : {0.3, 0.15, 0.08}) {
    const Mesh result = remesh_all(tube, length).mesh;
    const MeshAttributes& a = result.attributes();
    double sum = 0.0;
    for (std::size_t f = 0; f < result.face_count(); ++f) {
      const Vector2d& p = a.uvs[a.corner_uvs[3 * f]];
      const Vector2d x = a.uvs[a.corner_uvs[3 * f + 1]] - p;
      const Vector2d y = a.uvs[a.corner_uvs[3 * f + 2]] - p;
      const double area = 0.5 * (x.x() * y.y() - x.y() * y.x());
      ASSERT_GT(area, 0.0) << "face " << f << " is turned over in the texture";
      sum += area;
    }
    // Triangles that all look up and fill the square between its four fixed sides cover it once.
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(RemeshAttributes, TextureFollowsThePositionAroundTheTube) {
  const Mesh result = remesh_all(cut_tube(60, 20), 0.1).mesh;
  const MeshAttributes& a = result.attributes();
  for (std::size_t c = 0; c < a.corner_uvs.size(); ++c) {
    const Vector3d& p = result.positions[result.face_vertices()[c]];
    const Vector2d& uv = a.uvs[a.corner_uvs[c]];
    const double angle = 2.0 * std::numbers::pi * uv.x();
    ASSERT_LT((p - Vector3d(std::cos(angle), std::sin(angle), 3.0 * uv.y())).norm(), 2e-3);
  }
}

TEST(RemeshAttributes, StoredCornerNormalsAreBlended) {
  Mesh mesh = icosphere(3);
  mesh.edit_attributes().normals = mesh.positions;
  mesh.edit_attributes().corner_normals = mesh.face_vertices();
  const Mesh result = remesh_all(mesh, 0.1).mesh;
  const MeshAttributes& a = result.attributes();
  ASSERT_EQ(a.corner_normals.size(), result.face_vertices().size());
  for (std::size_t c = 0; c < a.corner_normals.size(); ++c) {
    const Vector3d wanted = result.positions[result.face_vertices()[c]].normalized();
    ASSERT_LT((a.normals[a.corner_normals[c]] - wanted).norm(), 0.01);
  }
}

TEST(RemeshAttributes, ListsHoldNoTextureThatOnlyTheOldPatchUsed) {
  Mesh mesh = rich_plane(16);
  mesh.edit_attributes().uvs.emplace_back(7.0, 7.0);  // used by nothing before either
  const Mesh result = remesh_all(mesh, 0.1).mesh;
  const MeshAttributes& a = result.attributes();
  std::vector<char> is_used(a.uvs.size(), 0);
  for (const Index i : a.corner_uvs) is_used[i] = 1;
  EXPECT_EQ(std::ranges::count(is_used, 0), 1);
  EXPECT_THAT(a.uvs, ::testing::Contains(Vector2d(7.0, 7.0)));
}

TEST(RemeshAttributes, CornersWithoutTextureStayWithout) {
  Mesh mesh = rich_plane(12);
  std::ranges::fill(mesh.edit_attributes().corner_uvs, kNoIndex);
  const Mesh result = remesh_all(mesh, 0.05).mesh;
  EXPECT_THAT(result.attributes().corner_uvs, ::testing::Each(kNoIndex));
}

}  // namespace
}  // namespace lapwing
