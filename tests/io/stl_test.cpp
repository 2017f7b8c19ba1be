#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const WriteOptions kAscii{.encoding = Encoding::ascii};

TEST(Stl, CornersAreWeldedWhereTheirPositionsAreEqual) {
  const TemporaryFolder folder;
  const Mesh sphere = icosphere(2);
  write_mesh(sphere, folder / "a.stl", kAscii);
  const Mesh mesh = read_mesh(folder / "a.stl");
  EXPECT_EQ(mesh.vertex_count(), sphere.vertex_count());
  EXPECT_EQ(mesh.face_count(), sphere.face_count());
}

TEST(Stl, BothZerosAreOnePosition) {
  const TemporaryFolder folder;
  const Mesh mesh = read_mesh(folder.file(
      "a.stl",
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex -0 0 -0\n"
      "endloop\nendfacet\nendsolid\n"));
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(0, 1, 0));
}

TEST(Stl, BinaryFileMayStartWithTheWordSolid) {
  const TemporaryFolder folder;
  write_mesh(icosphere(1), folder / "a.stl");
  std::string bytes = content_of(folder / "a.stl");
  bytes.replace(0, 12, "solid sphere");
  const Mesh mesh = read_mesh(folder.file("b.stl", bytes));
  EXPECT_EQ(mesh.vertex_count(), icosphere(1).vertex_count());
}

TEST(Stl, SolidsAreGroups) {
  const TemporaryFolder folder;
  const std::string facet =
      "  FACET normal 0 0 1\n outer loop\n vertex 0 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\n"
      " endfacet\n";
  const std::string text = "solid left arm\n" + facet +
                           "endsolid left arm\nsolid empty\nendsolid\nsolid b\n" + facet +
                           "endsolid b\n";
  const Mesh mesh = read_mesh(folder.file("a.stl", text));
  EXPECT_THAT(mesh.attributes().groups, ElementsAre("left arm", "empty", "b"));
  EXPECT_THAT(mesh.attributes().face_groups, ElementsAre(0, 2));
}

TEST(Stl, KeywordsMayBeSplitJoinedOrInUpperCase) {
  const TemporaryFolder folder;
  const std::string corners = "vertex 0 0 0\nvertex 1 0 0\nVERTEX 0 1 0\n";
  const std::string facet = "facet normal 0 0 1\nouter loop\n" + corners + "end loop\nendfacet\n" +
                            "FACET\tNORMAL 0 0 1\nOUTERLOOP\n" + corners + "ENDLOOP\nEND FACET\n";
  const std::string text = "solid a\n" + facet + "end solid a\n\nmade by hand\nSOLID b\n" + facet +
                           "EndSolid b\nmore text";
  const Mesh mesh = read_mesh(folder.file("a.stl", text));
  EXPECT_EQ(mesh.face_count(), 4U);
  EXPECT_THAT(mesh.attributes().groups, ElementsAre("a", "b"));
  EXPECT_THAT(mesh.attributes().uneditable, ElementsAre("lines between or after the solids"));
  Mesh moved = mesh;
  moved.positions[0].x() = -7.5;
  write_mesh(moved, folder / "b.stl");
  EXPECT_THAT(content_of(folder / "b.stl"),
              AllOf(HasSubstr("vertex -7.5 0 0\n"), HasSubstr("end solid a\n\nmade by hand\n"),
                    HasSubstr("EndSolid b\nmore text")));
}

TEST(Stl, ByteOrderMarkIsSkipped) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_mesh(folder.file("a.stl", "\xEF\xBB\xBFsolid\nendsolid\n")).face_count(), 0U);
}

TEST(Stl, VerticesThatItCannotHoldAreRefusedByTheirNumber) {
  const TemporaryFolder folder;
  Mesh mesh = grid(1, 1);
  mesh.positions[2].y() = 1e39;
  write_mesh(mesh, folder / "a.stl", kAscii);
  EXPECT_THAT(error_message<InputError>([&] { write_mesh(mesh, folder / "b.stl"); }),
              AllOf(HasSubstr("vertex 2 "), HasSubstr("32-bit floats of STL"), HasSubstr("scale")));
  mesh.positions[2].y() = std::numeric_limits<double>::quiet_NaN();
  for (const WriteOptions& options : {kAscii, WriteOptions{}}) {
    EXPECT_THAT(error_message<InputError>([&] { write_mesh(mesh, folder / "b.stl", options); }),
                AllOf(HasSubstr("vertex 2 "), HasSubstr("`lapwing check MESH --fix OUT`")));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "b.stl"));
}

TEST(Stl, AttributeWordsAreCarried) {
  const TemporaryFolder folder;
  Mesh mesh = grid(1, 1);
  mesh.edit_attributes().face_extras.push_back({"attribute", "ushort", 1, {0, 40000}});
  write_mesh(mesh, folder / "a.stl");
  const Mesh again = read_mesh(folder / "a.stl");
  ASSERT_EQ(again.attributes().face_extras.size(), 1U);
  EXPECT_THAT(again.attributes().face_extras[0].values, ElementsAre(0, 40000));
}

TEST(Stl, FewBytesBehindTheLastTriangleAreKept) {
  const TemporaryFolder folder;
  write_mesh(grid(1, 1), folder / "a.stl");
  const std::string bytes = content_of(folder / "a.stl") + "made by hand";
  write_mesh(read_mesh(folder.file("b.stl", bytes)), folder / "c.stl");
  EXPECT_EQ(content_of(folder / "c.stl"), bytes);
}

TEST(Stl, ReportSaysWhatTrianglesCannotHold) {
  const TemporaryFolder folder;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 0.1}};
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  const WriteReport report = write_mesh(mesh, folder / "a.stl");
  EXPECT_THAT(report.not_carried, Contains(HasSubstr("polygons")));
  EXPECT_THAT(report.not_carried, Contains(HasSubstr("vertices without a face (1)")));
}

TEST(Stl, BigEndianIsRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_mesh(grid(1, 1), folder / "a.stl", {.encoding = Encoding::big_endian}),
               InputError);
}

}  // namespace
}  // namespace lapwing
