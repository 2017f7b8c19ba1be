#include "lapwing/mesh/compact.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

// A quad and a triangle that share an edge, with one value of every attribute per element: values
// tell the element they belong to.
Mesh quad_and_triangle() {
  Mesh mesh;
  for (int v = 0; v < 5; ++v) mesh.positions.emplace_back(v, 0, 0);
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  mesh.add_face(std::array<Index, 3>{2, 1, 4});
  MeshAttributes& a = mesh.edit_attributes();
  a.uvs.assign(7, Eigen::Vector2d::Zero());
  a.corner_uvs = {0, 1, 2, 3, 4, 5, 6};
  a.corner_normals = {6, 5, 4, 3, 2, 1, kNoIndex};
  a.face_colors = {{0, 0, 0, 1}, {1, 0, 0, 1}};
  a.materials = {"wood", "steel"};
  a.face_materials = {1, 0};
  a.groups = {"left"};
  a.face_groups = {kNoIndex, 0};
  a.face_extras = {{"quality", "float", 2, {10, 11, 20, 21}}};
  for (int v = 0; v < 5; ++v) a.vertex_colors.emplace_back(static_cast<float>(v), 0, 0, 1);
  a.vertex_extras = {{"id", "int", 1, {0, 1, 2, 3, 4}}};
  a.comments = {"a comment"};
  return mesh;
}

TEST(KeepFaces, CarriesEveryFaceAndCornerAttribute) {
  Mesh mesh = quad_and_triangle();
  keep_faces(mesh, {0, 1});
  const MeshAttributes& a = mesh.attributes();
  ASSERT_EQ(mesh.face_count(), 1U);
  EXPECT_THAT(mesh.face(0), ElementsAre(2, 1, 4));
  EXPECT_THAT(a.corner_uvs, ElementsAre(4, 5, 6));
  EXPECT_THAT(a.corner_normals, ElementsAre(2, 1, kNoIndex));
  EXPECT_THAT(a.face_colors, ElementsAre(Eigen::Vector4f(1, 0, 0, 1)));
  EXPECT_THAT(a.face_materials, ElementsAre(0));
  EXPECT_THAT(a.face_groups, ElementsAre(0));
  EXPECT_THAT(a.face_extras[0].values, ElementsAre(20, 21));
  EXPECT_EQ(a.uvs.size(), 7U);
  EXPECT_EQ(mesh.vertex_count(), 5U);
}

TEST(KeepVertices, RenumbersAndCarriesEveryVertexAttribute) {
  Mesh mesh = quad_and_triangle();
  mesh.edit_attributes().has_vertex_normals = true;
  for (int v = 0; v < 5; ++v) mesh.edit_attributes().normals.emplace_back(0, 0, v);
  const std::vector<Index> sources = keep_vertices(mesh, {0, 1, 1, 0, 1});
  EXPECT_THAT(sources, ElementsAre(1, 2, 4));
  ASSERT_EQ(mesh.face_count(), 1U);
  EXPECT_THAT(mesh.face(0), ElementsAre(1, 0, 2));
  EXPECT_EQ(mesh.positions[2].x(), 4.0);
  EXPECT_EQ(mesh.attributes().normals[2].z(), 4.0);
  EXPECT_EQ(mesh.attributes().vertex_colors[2].x(), 4.0F);
  EXPECT_THAT(mesh.attributes().vertex_extras[0].values, ElementsAre(1, 2, 4));
  EXPECT_THAT(mesh.attributes().face_materials, ElementsAre(0));
}

TEST(KeepVertices, KeepingAllChangesNothing) {
  Mesh mesh = quad_and_triangle();
  const Mesh before = mesh;
  keep_vertices(mesh, KeepMask(5, 1));
  EXPECT_EQ(mesh.face_vertices(), before.face_vertices());
  EXPECT_EQ(mesh.face_starts(), before.face_starts());
  EXPECT_EQ(mesh.attributes().corner_uvs, before.attributes().corner_uvs);
  EXPECT_EQ(mesh.attributes().vertex_extras[0].values, before.attributes().vertex_extras[0].values);
}

TEST(KeepVertices, LeavesFileNormalsOfCornersAlone) {
  Mesh mesh = quad_and_triangle();
  mesh.edit_attributes().normals.assign(7, Eigen::Vector3d::UnitZ());
  keep_vertices(mesh, {0, 1, 1, 0, 1});
  EXPECT_EQ(mesh.attributes().normals.size(), 7U);
}

TEST(ReplaceVertices, CopiesAVertexWithItsAttributes) {
  Mesh mesh = quad_and_triangle();
  replace_vertices(mesh, std::array<Index, 6>{0, 1, 2, 3, 4, 2});
  EXPECT_EQ(mesh.positions[5], mesh.positions[2]);
  EXPECT_EQ(mesh.attributes().vertex_colors[5].x(), 2.0F);
  EXPECT_EQ(mesh.attributes().vertex_extras[0].values[5], 2.0);
}

TEST(ReplaceFaces, CutsAPolygonAlongItsDiagonal) {
  Mesh mesh = quad_and_triangle();
  FaceSources sources;
  sources.faces = {0, 0};
  sources.starts = {0, 3, 6};
  sources.corners = {0, 1, 2, 0, 2, 3};
  replace_faces(mesh, sources);
  EXPECT_THAT(mesh.face(1), ElementsAre(0, 2, 3));
  EXPECT_THAT(mesh.attributes().corner_uvs, ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_THAT(mesh.attributes().face_materials, ElementsAre(1, 1));
}

TEST(KeepFaces, RefusesAnAttributeOfTheWrongLengthByName) {
  Mesh mesh = quad_and_triangle();
  mesh.edit_attributes().vertex_extras[0].values.pop_back();
  EXPECT_THAT(error_message<InputError>([&] {
                keep_faces(mesh, {1, 0});
              }),
              ::testing::HasSubstr("'id'"));
  EXPECT_EQ(mesh.face_count(), 2U);
}

TEST(DropUnusedAttributes, LeavesWhatCornersAndFacesNameUnderNewNumbers) {
  Mesh mesh = quad_and_triangle();
  mesh.edit_attributes().normals.assign(7, Eigen::Vector3d::UnitZ());
  for (int n = 0; n < 7; ++n) mesh.edit_attributes().uvs[static_cast<std::size_t>(n)].x() = n;
  keep_faces(mesh, {1, 0});
  drop_unused_attributes(mesh);
  const MeshAttributes& a = mesh.attributes();
  EXPECT_THAT(a.corner_uvs, ElementsAre(0, 1, 2, 3));
  ASSERT_EQ(a.uvs.size(), 4U);
  EXPECT_EQ(a.uvs[3].x(), 3.0);
  EXPECT_THAT(a.corner_normals, ElementsAre(3, 2, 1, 0));
  EXPECT_EQ(a.normals.size(), 4U);
  EXPECT_THAT(a.materials, ElementsAre("steel"));
  EXPECT_THAT(a.face_materials, ElementsAre(0));
  EXPECT_THAT(a.groups, ElementsAre());
  EXPECT_THAT(a.face_groups, ElementsAre(kNoIndex));
}

TEST(DropUnusedAttributes, LeavesNormalsThatAreOnePerVertex) {
  Mesh mesh = quad_and_triangle();
  mesh.edit_attributes().has_vertex_normals = true;
  mesh.edit_attributes().corner_normals.clear();
  mesh.edit_attributes().normals.assign(5, Eigen::Vector3d::UnitZ());
  keep_faces(mesh, {1, 0});
  drop_unused_attributes(mesh);
  EXPECT_EQ(mesh.attributes().normals.size(), mesh.vertex_count());
}

}  // namespace
}  // namespace lapwing
