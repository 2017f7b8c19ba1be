#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;

class Obj : public ::testing::Test {
 protected:
  Mesh read(std::string_view text) const { return read_mesh(folder_.file("a.obj", text)); }

  TemporaryFolder folder_;
};

TEST_F(Obj, CornersMayBeRelativeAndForward) {
  const Mesh mesh = read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 +1 2\n");
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 2, 0, 1, 2, 3, 0, 1));
}

TEST_F(Obj, EveryFormOfCornerIsRead) {
  const Mesh mesh = read(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 1\nvt 0 0\nvn 0 0 1\n"
      "f 1 2/ 3//\nf 1/2 2/1 3/2\nf 1//1 2//-1 3//1\nf 1/1/1 2/2/1 3/-1/1\n");
  const Index no = kNoIndex;
  EXPECT_THAT(mesh.attributes().corner_uvs, ElementsAre(no, no, no, 1, 0, 1, no, no, no, 0, 1, 1));
  EXPECT_THAT(mesh.attributes().corner_normals,
              ElementsAre(no, no, no, no, no, no, 0, 0, 0, 0, 0, 0));
}

TEST_F(Obj, TextureCoordinatesAndNormalsThatAreNotThereAreLeftOut) {
  const Mesh mesh =
      read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1/1 2/-9/1 3/5/0\nf 1/2 2 3\nvt 1 1\n");
  EXPECT_THAT(mesh.attributes().corner_uvs,
              ElementsAre(0, kNoIndex, kNoIndex, 1, kNoIndex, kNoIndex));
  EXPECT_TRUE(mesh.attributes().corner_normals.empty());
  EXPECT_THAT(mesh.attributes().uneditable,
              ElementsAre("references to missing normals (3)",
                          "references to missing texture coordinates (2)"));
}

TEST_F(Obj, LinesMayBeContinuedAndEndInAnyWay) {
  const Mesh mesh = read("v\t0 0 \\\r\n 0\r\nv 1 0 0\rv 0  1 0   \n\n   f 1 \\\n2 3 # and so on");
  EXPECT_EQ(mesh.vertex_count(), 3U);
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 2));
}

TEST_F(Obj, NumbersComeInAllSpellings) {
  const Mesh mesh = read("v +1e2 .5 2.\nv -1E-2 nan inf\nv 1.#INF -1.#IND00 -inf\n");
  EXPECT_EQ(mesh.positions[0], Eigen::Vector3d(100, 0.5, 2));
  EXPECT_EQ(mesh.positions[1].x(), -0.01);
  EXPECT_TRUE(std::isnan(mesh.positions[1].y()));
  EXPECT_EQ(mesh.positions[1].z(), HUGE_VAL);
  EXPECT_EQ(mesh.positions[2].x(), HUGE_VAL);
  EXPECT_TRUE(std::isnan(mesh.positions[2].y()));
  EXPECT_EQ(mesh.positions[2].z(), -HUGE_VAL);
}

TEST_F(Obj, ByteOrderMarkIsSkipped) {
  EXPECT_EQ(read("\xEF\xBB\xBFv 1 2 3\n").vertex_count(), 1U);
}

TEST_F(Obj, EmptyFileIsAnEmptyMesh) {
  EXPECT_EQ(read("").vertex_count(), 0U);
  EXPECT_EQ(read("# nothing here\n").face_count(), 0U);
}

TEST_F(Obj, VertexColoursAreInUnitRangeWhateverTheFileUses) {
  EXPECT_EQ(read("v 0 0 0 0.25 0.5 1\n").attributes().vertex_colors[0],
            Eigen::Vector4f(0.25F, 0.5F, 1, 1));
  EXPECT_EQ(read("v 0 0 0 0 51 255\n").attributes().vertex_colors[0],
            Eigen::Vector4f(0, 0.2F, 1, 1));
}

TEST_F(Obj, VertexColoursMayFollowAWeightOrHaveAnOpacity) {
  const auto colors = [&](std::string_view text) { return read(text).attributes().vertex_colors; };
  EXPECT_THAT(colors("v 0 0 0 1 0.5 0.25 0\nv 1 0 0 1 0 0 1\nv 2 0 0\nv 3 0 0 0 1 0\n"),
              ElementsAre(Eigen::Vector4f(0.5F, 0.25F, 0, 1), Eigen::Vector4f(0, 0, 1, 1),
                          Eigen::Vector4f::Ones(), Eigen::Vector4f(0, 1, 0, 1)));
  EXPECT_THAT(colors("v 0 0 0 1 255 51 0\n"), ElementsAre(Eigen::Vector4f(1, 0.2F, 0, 1)));
  EXPECT_THAT(colors("v 0 0 0 1 0.5 0.25 1\nv 1 0 0 0.5 0 0 0.75\n"),
              ElementsAre(Eigen::Vector4f(1, 0.5F, 0.25F, 1), Eigen::Vector4f(0.5F, 0, 0, 0.75F)));
}

TEST_F(Obj, ColoursOfZBrushAreReadInTheOrderOfTheVertices) {
  const Mesh mesh = read(
      "# made by ZBrush\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n#MRGB ffff0000FF00FF00\r\n"
      "#MRGB 000033ff\n#MRGB is no colour\nf 1 2 3\n");
  EXPECT_THAT(mesh.attributes().vertex_colors,
              ElementsAre(Eigen::Vector4f(1, 0, 0, 1), Eigen::Vector4f(0, 1, 0, 1),
                          Eigen::Vector4f(0, 0.2F, 1, 1), Eigen::Vector4f::Ones()));
  EXPECT_THAT(mesh.attributes().comments, ElementsAre("made by ZBrush", "MRGB is no colour"));
  EXPECT_THAT(mesh.attributes().uneditable, ElementsAre("masked vertices (1)"));
  EXPECT_THAT(read("v 0 0 0\n#MRGB ff0000ffff000000\n").attributes().uneditable,
              ElementsAre("colours (#MRGB) of vertices that do not exist (1)"));
  // Colours after the positions have priority because they are more precise.
  EXPECT_THAT(read("v 0 0 0 0.25 0.5 1\n#MRGB ff4080ff\n").attributes().vertex_colors,
              ElementsAre(Eigen::Vector4f(0.25F, 0.5F, 1, 1)));
}

TEST_F(Obj, GroupsAndMaterialsHoldForTheFacesThatFollow) {
  const Mesh mesh = read(
      "mtllib my colours.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng left arm\nusemtl a\nf 1 2 3\n"
      "usemtl b\nf 1 2 3\ng\nusemtl a\nf 1 2 3\n");
  EXPECT_THAT(mesh.attributes().material_libraries, ElementsAre("my colours.mtl"));
  EXPECT_THAT(mesh.attributes().groups, ElementsAre("left arm"));
  EXPECT_THAT(mesh.attributes().face_groups, ElementsAre(kNoIndex, 0, 0, kNoIndex));
  EXPECT_THAT(mesh.attributes().materials, ElementsAre("a", "b"));
  EXPECT_THAT(mesh.attributes().face_materials, ElementsAre(kNoIndex, 0, 1, 0));
}

TEST_F(Obj, WhatCannotBeEditedIsCounted) {
  const Mesh mesh = read("v 0 0 0 2\nv 1 0 0\nl 1 2\np 1\ns 1\ncurv 0 1 1 2\n");
  EXPECT_THAT(mesh.attributes().uneditable,
              ElementsAre("line elements (1)", "other statements (1)", "point elements (1)",
                          "smoothing groups (1)", "vertex weights (1)"));
}

TEST_F(Obj, MaterialLibraryWithoutANameIsCounted) {
  const MeshAttributes a = read("mtllib\nmtllib \t\nv 0 0 0\n").attributes();
  EXPECT_THAT(a.material_libraries, ::testing::IsEmpty());
  EXPECT_THAT(a.uneditable, ElementsAre("mtllib statements without a file name (2)"));
}

TEST_F(Obj, MissingMaterialLibraryIsNoted) {
  const Mesh mesh = read("mtllib a.mtl\nv 0 0 0\n");
  EXPECT_THAT(write_mesh(mesh, folder_ / "b.obj").notes,
              ElementsAre(::testing::HasSubstr("material library 'a.mtl'")));
  folder_.file("a.mtl", "newmtl a\n");
  EXPECT_THAT(write_mesh(mesh, folder_ / "b.obj").notes, ElementsAre());
}

}  // namespace
}  // namespace lapwing
