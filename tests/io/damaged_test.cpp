// Tests files with defects that `read_damaged_mesh` skips.
#include <array>
#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/gltf_sample.h"
#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

struct Damaged {
  std::string name;  ///< of the file
  std::string content;
  FileDefectKind kind;
  std::string place;
  std::string message;         ///< a substring of the message
  std::vector<Index> corners;  ///< of the mesh that is read

  friend void PrintTo(const Damaged& d, std::ostream* out) { *out << d.name << " " << d.message; }
};

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n";
const std::string kOff = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n";
const std::string kPly = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";

std::string text_ply(int faces, const std::string& list) {
  return "ply\nformat ascii 1.0\n" + kPly + "element face " + std::to_string(faces) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + kOff + list;
}

// Returns a PLY file with four vertices at the origin and the faces 0 1 2 and 1 3 2. The last `cut`
// bytes are missing.
std::string binary_ply(std::size_t cut) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + kPly +
                      "element face 2\nproperty list uchar uchar vertex_indices\nend_header\n" +
                      std::string(48, '\0') + std::string("\3\0\1\2\3\1\3\2", 8);
  return bytes.substr(0, bytes.size() - cut);
}

std::string facet(const std::string& corners, const std::string& end = "endloop\nendfacet\n") {
  return "facet normal 0 0 1\nouter loop\n" + corners + end;
}
const std::string kFacet = facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
const std::string kSpelledFacet =
    "\tFACET NORMAL 0 0 1\n\tOUTERLOOP\n\tVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\nEND\tLOOP\n"
    "END FACET\n";

// Returns an STL file with one triangle, the triangle count `count`, and `more` bytes at the end.
std::string binary_stl(char count, std::size_t more = 0) {
  const std::string one("\0\0\x80\x3F", 4);  // 1 as a float
  return std::string(80, ' ') + count + std::string(3 + 12 + 12, '\0') + one +
         std::string(8 + 4, '\0') + one + std::string(4 + 2 + more, '\0');
}

constexpr auto kShort = FileDefectKind::short_face;
constexpr auto kMissing = FileDefectKind::missing_vertex;
constexpr auto kCount = FileDefectKind::wrong_count;
constexpr auto kEnd = FileDefectKind::missing_end;
const std::vector<Index> kOne{0, 1, 2};
const std::vector<Index> kBoth{0, 1, 2, 1, 3, 2};

const std::array kDamaged{
    Damaged{"a.obj", kObj + "f 1 2\nf 2 4 3\n", kShort, "line 6", "this one has 2", kBoth},
    Damaged{"a.obj", kObj + "f 4\n", kShort, "line 6", "this one has 1", kOne},
    Damaged{"a.obj", kObj + "f\nf 2 4 3\n", kShort, "line 6", "this one has 0", kBoth},
    Damaged{"a.obj", "f 1 2 9\nf 7 8 9\n" + kObj, kMissing, "line 1", "names vertex 9", kOne},
    Damaged{"a.obj", kObj + "f 0 1 2\nf 2 4 3\n", kMissing, "line 6", "names vertex 0", kBoth},
    Damaged{"a.obj", kObj + "f 1 -5 -6\n", kMissing, "line 6", "names vertex -5", kOne},
    Damaged{"a.off", "OFF\n4 3 0\n" + kOff + "2 0 1\n3 1 3 2\n", kShort, "line 8", "has 2", kBoth},
    Damaged{"a.off", "OFF\n4 2 0\n" + kOff + "0\n", kShort, "line 8", "has 0", kOne},
    Damaged{"a.off", "OFF\n4 3 0\n" + kOff + "3 1 3 2\n3 0 1 4", kMissing, "line 9",
            "face 2 names vertex 4", kBoth},
    Damaged{"a.off", "OFF\n4 9 0\n" + kOff + "3 1 3 2\n", kCount, "line 2",
            "promises 9 faces, but the file ends after 2", kBoth},
    Damaged{"a.off", "OFF\n4 3 0\n" + kOff + "3 1 3\n", kCount, "line 2", "ends after 1", kOne},
    Damaged{"a.off", "OFF\n4 3 0\n" + kOff + "3 1 3 2", kCount, "line 2", "ends after 1", kOne},
    Damaged{"a.ply", text_ply(3, "2 0 1\n3 1 3 2\n"), kShort, "line 15", "has 2", kBoth},
    Damaged{"a.ply", text_ply(2, "3 0 1 -1\n"), kMissing, "line 15", "names vertex -1", kOne},
    Damaged{"a.ply", text_ply(900000000, "3 1 3 2\n"), kCount, "line 7",
            "promises 900000000 faces, but the file ends after 2", kBoth},
    Damaged{"a.ply", text_ply(3, "3 1 3\n"), kCount, "line 7", "ends after 1", kOne},
    Damaged{"a.ply", text_ply(3, "3 1"), kCount, "line 7", "ends after 1", kOne},
    Damaged{"a.ply", text_ply(3, "3 1 3 2"), kCount, "line 7", "ends after 1", kOne},
    Damaged{"a.ply", binary_ply(1), kCount, "byte", "ends after 1", kOne},
    Damaged{"a.ply", binary_ply(4), kCount, "byte", "ends after 1", kOne},
    Damaged{"a.stl", binary_stl(0), kCount, "byte 80", "0 triangles, but the file's size fits 1",
            kOne},
    Damaged{"a.stl", binary_stl(5, 20), kCount, "byte 80", "promises 5 triangles", kOne},
    Damaged{"a.stl", "solid a\n" + kFacet, kEnd, "line 9", "found the end of the file", kOne},
    Damaged{"a.stl", "solid a\n" + kFacet + "solid b\nendsolid\n", kEnd, "line 9", "found 'solid'",
            kOne},
    Damaged{"a.stl", "solid a\n" + kFacet + facet("vertex 0 0 0\nvertex 1 0", ""), kEnd, "line 9",
            "ends within this facet", kOne},
    Damaged{"a.stl", "solid a\n" + kFacet + "ends", kEnd, "line 9", "within the word 'ends'", kOne},
    Damaged{"a.stl", "solid a\n" + kSpelledFacet + "FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 5", kEnd,
            "line 9", "ends within this facet", kOne},
    Damaged{"a.stl", "solid a\n" + kFacet + "facet nor", kEnd, "line 9", "ends within", kOne},
};

class DamagedFile : public ::testing::TestWithParam<Damaged> {};

TEST_P(DamagedFile, IsReadWithoutItsDefectsWhichAreNamed) {
  const TemporaryFolder folder;
  const auto path = folder.file(GetParam().name, GetParam().content);
  const DamagedMesh damaged = read_damaged_mesh(path);
  ASSERT_THAT(damaged.defects, SizeIs(1));
  EXPECT_EQ(damaged.defects[0].kind, GetParam().kind);
  EXPECT_THAT(damaged.defects[0].first[0],
              AllOf(StartsWith(GetParam().place), HasSubstr(GetParam().message)));
  EXPECT_EQ(damaged.mesh.face_vertices(), GetParam().corners);
}

TEST_P(DamagedFile, IsRefusedElsewhereWithTheCommandThatRepairsIt) {
  const TemporaryFolder folder;
  const auto path = folder.file(GetParam().name, GetParam().content);
  EXPECT_THAT(error_message<InputError>([&] { read_mesh(path); }),
              AllOf(StartsWith(path.string()), HasSubstr(GetParam().message),
                    HasSubstr("`lapwing check MESH --fix OUT`")));
}

TEST_P(DamagedFile, IsWholeOnceWritten) {
  const TemporaryFolder folder;
  const Mesh mesh = read_damaged_mesh(folder.file(GetParam().name, GetParam().content)).mesh;
  write_mesh(mesh, folder / ("whole-" + GetParam().name));
  EXPECT_EQ(read_mesh(folder / ("whole-" + GetParam().name)).face_vertices(), GetParam().corners);
}

INSTANTIATE_TEST_SUITE_P(All, DamagedFile, ::testing::ValuesIn(kDamaged));

TEST(DamagedFile, WithoutDefectsIsReadAsEver) {
  const TemporaryFolder folder;
  const DamagedMesh damaged = read_damaged_mesh(folder.file("a.obj", kObj));
  EXPECT_THAT(damaged.defects, IsEmpty());
  EXPECT_EQ(damaged.mesh.source, damaged.file);
}

TEST(DamagedFile, CountsAllDefectsAndListsTheFirst) {
  const TemporaryFolder folder;
  std::string text = kObj;
  for (int k = 0; k < 20; ++k) text += "f 1 2\nf 1 2 77 88\n";
  const DamagedMesh damaged = read_damaged_mesh(folder.file("a.obj", text));
  ASSERT_THAT(damaged.defects, SizeIs(2));
  for (const FileDefect& defect : damaged.defects) {
    EXPECT_EQ(defect.count, 20U);
    EXPECT_THAT(defect.first, SizeIs(kMaxListedPlaces));
  }
  EXPECT_THAT(damaged.defects[1].first[7], StartsWith("line 21: the face names vertex 77"));
}

TEST(DamagedFile, OtherFacesKeepTheirMaterialsAndTextureCoordinates) {
  const TemporaryFolder folder;
  const Mesh mesh =
      read_damaged_mesh(folder.file("a.obj",
                                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\n"
                                    "usemtl red\nf 1/1 2/2\nusemtl blue\nf 2/2 4/1 3/1\n"
                                    "f 1/1 2/2 9/1\nusemtl red\nf 1/1 2/1 3/2\n"))
          .mesh;
  const MeshAttributes& a = mesh.attributes();
  EXPECT_THAT(mesh.face_vertices(), ElementsAre(1, 3, 2, 0, 1, 2));
  EXPECT_THAT(a.corner_uvs, ElementsAre(1, 0, 0, 0, 0, 1));
  ASSERT_THAT(a.face_materials, SizeIs(2));
  EXPECT_EQ(a.materials[a.face_materials[0]], "blue");
  EXPECT_EQ(a.materials[a.face_materials[1]], "red");
}

TEST(DamagedFile, FaceColoursStayWithTheirFaces) {
  const TemporaryFolder folder;
  const std::string text = "ply\nformat ascii 1.0\n" + kPly +
                           "element face 4\nproperty list uchar int vertex_indices\n"
                           "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                           "property int id\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n"
                           "2 0 1 9 9 9 7\n3 0 1 2 255 0 0 8\n3 1 3 2 0 0 255 9\n3 0 1 2 1";
  const DamagedMesh damaged = read_damaged_mesh(folder.file("a.ply", text));
  EXPECT_THAT(damaged.defects, SizeIs(2));
  const MeshAttributes& a = damaged.mesh.attributes();
  ASSERT_THAT(a.face_colors, SizeIs(2));
  EXPECT_EQ(a.face_colors[0], Eigen::Vector4f(1, 0, 0, 1));
  EXPECT_EQ(a.face_colors[1], Eigen::Vector4f(0, 0, 1, 1));
  EXPECT_THAT(a.face_extras.at(0).values, ElementsAre(8, 9));
}

TEST(DamagedFile, TrianglesOfAGltfFileThatNameMissingVerticesAreLeftOut) {
  const TemporaryFolder folder;
  test::GltfSample sample;
  const std::size_t positions = sample.add<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3,
                                                  R"(,"min":[0,0,0],"max":[1,1,0])");
  const std::size_t indices = sample.add<std::uint16_t>({0, 1, 3, 0, 1, 2}, 5123, "SCALAR", 6);
  const auto path = folder.file(
      "a.glb",
      sample.glb(R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{)"
                 R"("primitives":[{"attributes":{"POSITION":)" +
                 std::to_string(positions) + R"(},"indices":)" + std::to_string(indices) + "}]}]"));
  const DamagedMesh damaged = read_damaged_mesh(path);
  ASSERT_THAT(damaged.defects, SizeIs(1));
  EXPECT_EQ(damaged.defects[0].kind, FileDefectKind::missing_vertex);
  EXPECT_THAT(damaged.defects[0].first[0],
              HasSubstr("/meshes/0/primitives/0: corner 2 names vertex 3, but there are 3"));
  EXPECT_THAT(damaged.mesh.face_vertices(), ElementsAre(0, 1, 2));
  EXPECT_THAT(error_message<InputError>([&] { read_mesh(path); }), HasSubstr("lapwing check"));
}

}  // namespace
}  // namespace lapwing
