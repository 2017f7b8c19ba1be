#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Mesh read_ply_text(std::string_view text) {
  const TemporaryFolder folder;
  return read_mesh(folder.file("a.ply", text));
}

TEST(Ply, EveryPropertyFindsItsPlace) {
  const Mesh mesh = read_ply_text(
      "ply\nformat ascii 1.0\ncomment by hand\nobj_info more\nelement vertex 3\n"
      "property uchar blue\nproperty double z\nproperty float x\nproperty float y\n"
      "property list uchar float weights\nproperty uchar red\nproperty uchar green\n"
      "property float s\nproperty float t\nproperty int label\n"
      "element face 1\nproperty float quality\nproperty list uchar int vertex_index\n"
      "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n"
      "255 3 1 2 2 0.5 0.5 0 51 0.25 0.75 7\n0 0 0 0 0 0 0 0 0 8\n0 0 0 1 1 9 0 0 1 1 9\n"
      "0.5 3 0 1 2\n0 1\n1 2\n");
  const MeshAttributes& a = mesh.attributes();
  EXPECT_EQ(mesh.positions[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(a.vertex_colors[0], Eigen::Vector4f(0, 0.2F, 1, 1));
  EXPECT_EQ(a.uvs[0], Eigen::Vector2d(0.25, 0.75));
  EXPECT_THAT(a.corner_uvs, ElementsAre(0, 1, 2));
  ASSERT_EQ(a.vertex_extras.size(), 1U);
  EXPECT_EQ(a.vertex_extras[0].name, "label");
  EXPECT_THAT(a.vertex_extras[0].values, ElementsAre(7, 8, 9));
  ASSERT_EQ(a.face_extras.size(), 1U);
  EXPECT_THAT(a.face_extras[0].values, ElementsAre(0.5));
  EXPECT_THAT(a.comments, ElementsAre("by hand", "more"));
  EXPECT_THAT(a.uneditable, ElementsAre("'edge' elements (2)", "'weights' lists (3)"));
}

TEST(Ply, ColoursMayBeFloatsWithAnOpacity) {
  const Mesh mesh = read_ply_text(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nproperty float red\nproperty float green\nproperty float blue\n"
      "property float alpha\nend_header\n0 0 0 1 0 0.2 0.5\n");
  EXPECT_THAT(mesh.attributes().vertex_colors, ElementsAre(Eigen::Vector4f(1, 0, 0.2F, 0.5F)));
}

TEST(Ply, TextureCoordinatesPerCornerAreRead) {
  const Mesh mesh = read_ply_text(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
      "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
      "3 0 1 2 6 0 0 1 0 0 1\n3 2 1 0 0\n");
  EXPECT_EQ(mesh.attributes().uvs[1], Eigen::Vector2d(1, 0));
  EXPECT_THAT(mesh.attributes().corner_uvs, ElementsAre(0, 1, 2, kNoIndex, kNoIndex, kNoIndex));
}

// Returns a PLY file with five vertices and `count` tristrips elements.
std::string strips_of(const std::string& count, const std::string& strips) {
  return "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
         "property float z\nelement tristrips " +
         count +
         "\nproperty list int int vertex_indices\nend_header\n"
         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n" +
         strips;
}

TEST(Ply, EverySecondTriangleOfAStripRunsTheOtherWay) {
  const Mesh mesh = read_ply_text(strips_of("1", "6 0 1 2 3 4 -1\n"));
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 2, 1, 3, 2, 2, 3, 4));
  EXPECT_THAT(mesh.face_starts(), ElementsAre(0, 3, 6, 9));
  EXPECT_THAT(mesh.attributes().uneditable, ElementsAre()) << "all of it is edited";
}

TEST(Ply, StripsEndAtMinusOneAndAtTheEndOfTheirRecord) {
  const Mesh mesh = read_ply_text(strips_of("3", "8 -1 0 1 2 -1 1 3 2\n2 0 1\n4 3 4 2 -1\n"));
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 2, 1, 3, 2, 3, 4, 2));
}

TEST(Ply, RepeatedVerticesJoinStripsWithoutATriangle) {
  const Mesh mesh = read_ply_text(strips_of("1", "8 0 1 2 2 1 1 3 4\n"));
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 2, 1, 4, 3))
      << "triangles without area count, too";
}

TEST(Ply, StripsAddTrianglesToTheFaces) {
  const Mesh both = read_ply_text(
      "ply\nformat ascii 1.0\nelement tristrips 1\nproperty float cost\n"
      "property list int int vertex_index\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty int label\n"
      "property list uchar float texcoord\nend_header\n"
      "0.5 3 1 3 2\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2 255 0 0 7 6 0 0 1 0 0 1\n");
  EXPECT_THAT(both.face_vertices(), ElementsAre(0, 1, 2, 1, 3, 2));
  EXPECT_THAT(both.attributes().face_colors,
              ElementsAre(Eigen::Vector4f(1, 0, 0, 1), Eigen::Vector4f(1, 1, 1, 1)));
  EXPECT_THAT(both.attributes().face_extras.at(0).values, ElementsAre(7, 0));
  EXPECT_THAT(both.attributes().corner_uvs, ElementsAre(0, 1, 2, kNoIndex, kNoIndex, kNoIndex));
  EXPECT_THAT(both.attributes().uneditable, ElementsAre("'cost' of triangle strips (1)"));
}

TEST(Ply, AVertexOfAStripThatTheFileDoesNotHaveIsNamed) {
  EXPECT_THAT(
      error_message<InputError>([] { read_ply_text(strips_of("2", "3 0 1 2\n4 0 1 2 5\n")); }),
      HasSubstr("a.ply:16: a triangle strip names vertex 5, but the file has 5"));
}

TEST(Ply, StripsStayWhenAVertexMoves) {
  const TemporaryFolder folder;
  const std::string text = strips_of("1", "6 0 1 2 3 4 -1\n");
  Mesh mesh = read_mesh(folder.file("a.ply", text));
  mesh.positions[4] = {0.0, 3.0, 0.0};
  write_mesh(mesh, folder / "b.ply");
  std::string moved = text;
  moved.replace(moved.find("0 2 0\n"), 6, "0 3 0\n");
  EXPECT_EQ(content_of(folder / "b.ply"), moved);
}

TEST(Ply, StripsOfUnsignedNumbersEndAtTheLargest) {
  using std::string_literals::operator""s;
  const Mesh mesh = read_ply_text(
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\n"
      "property uchar y\nproperty uchar z\nelement tristrips 1\n"
      "property list uchar uint vertex_indices\nend_header\n"
      "\0\0\0\1\0\0\0\1\0\5\0\0\0\0\1\0\0\0\2\0\0\0\xFF\xFF\xFF\xFF\1\0\0\0"s);
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 2));
}

TEST(Ply, FacesMayComeBeforeVertices) {
  const Mesh mesh = read_ply_text(
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n");
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 2));
  EXPECT_EQ(mesh.positions[2], Eigen::Vector3d(0, 1, 0));
}

TEST(Ply, HeaderMayEndItsLinesInCarriageReturnAndLineFeed) {
  using std::string_literals::operator""s;
  const Mesh mesh = read_ply_text(
      "ply\r\nformat binary_big_endian 1.0\r\nelement vertex 1\r\nproperty short x\r\n"
      "property short y\r\nproperty short z\r\nend_header\r\n\1\0\0\x02\xFF\xFF"s);
  EXPECT_EQ(mesh.positions[0], Eigen::Vector3d(256, 2, -1));
}

TEST(Ply, PointCloudWithoutFacesIsRead) {
  const Mesh mesh = read_ply_text(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n1 2 3\n");
  EXPECT_EQ(mesh.vertex_count(), 1U);
  EXPECT_EQ(mesh.face_count(), 0U);
}

TEST(Ply, PositionsOfFloatsAreWrittenAsFloatsOthersAsDoubles) {
  const TemporaryFolder folder;
  Mesh mesh = grid(2, 2);
  write_mesh(mesh, folder / "a.ply");
  EXPECT_THAT(content_of(folder / "a.ply"), ::testing::HasSubstr("property float x"));
  mesh.positions[0].x() = 0.1;
  write_mesh(mesh, folder / "a.ply");
  EXPECT_THAT(content_of(folder / "a.ply"), ::testing::HasSubstr("property double x"));
  EXPECT_EQ(read_mesh(folder / "a.ply").positions, mesh.positions);
}

TEST(Ply, LargeIndicesArePrintedInFull) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.positions.assign(100001, Eigen::Vector3d::Zero());
  mesh.add_face(std::array<Index, 3>{0, 1, 100000});
  write_mesh(mesh, folder / "a.ply", {.encoding = Encoding::ascii});
  EXPECT_EQ(read_mesh(folder / "a.ply").face_vertices(), mesh.face_vertices());
}

TEST(Ply, MovedVertexOfAnIntegerFileGetsRealCoordinates) {
  const TemporaryFolder folder;
  Mesh mesh = read_mesh(folder.file(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n"
      "end_header\n1 2 3\n"));
  mesh.positions[0].x() = 1.5;
  write_mesh(mesh, folder / "a.ply");
  EXPECT_EQ(read_mesh(folder / "a.ply").positions, mesh.positions);
}

}  // namespace
}  // namespace lapwing
